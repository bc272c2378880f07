// One block of memory for a group of images and buffers.
#pragma once

#include "engine/buffer.h"
#include "engine/image.h"
#include "engine/memory_block.h"

namespace alpenglow::engine {

/// Allocates one block that holds all of them, binds them, maps the block (or lets the host's hook
/// map it) when `properties` has HOST_VISIBLE, and makes the images' views. HOST_VISIBLE,
/// HOST_COHERENT and HOST_CACHED are required as given; DEVICE_LOCAL is preferred, and done without
/// where no type has it. On failure the block is freed, views are gone, `*out` is empty, and the
/// images and buffers must be destroyed by the caller (bound or not, they can't be used again):
/// OutOfDeviceMemory, OutOfHostMemory, Unsupported when no memory type suits all of them,
/// InvalidArgument when the hook's answer can't be used.
Status allocateAndBind(Device& device, const char* name, VkMemoryPropertyFlags properties,
                       Image* const* images, uint32_t imageCount, Buffer* const* buffers,
                       uint32_t bufferCount, MemoryBlock* out);

/// Unmaps what we mapped and frees now, and empties the struct. An empty block is ignored.
void freeBlock(Device& device, MemoryBlock* block);
/// The same once `frame` has completed.
void deferBlock(Device& device, uint64_t frame, MemoryBlock* block);

}  // namespace alpenglow::engine
