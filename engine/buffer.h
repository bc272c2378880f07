// Buffers. Plain structs: whoever owns one releases it.
#pragma once

#include "engine/device.h"

namespace alpenglow::engine {

struct Buffer {
  VkBuffer handle = VK_NULL_HANDLE;
  VkDeviceSize size = 0;   ///< As asked for.
  void* mapped = nullptr;  ///< Its first byte in host-visible memory, else null.
};

/// Makes the VkBuffer; memory comes with allocateAndBind. InvalidArgument for size 0 or no usage.
/// On failure `*out` is empty.
Status createBuffer(Device& device, VkDeviceSize size, VkBufferUsageFlags usage, const char* name,
                    Buffer* out);

/// Destroys the buffer now and empties the struct. Memory is freed apart, afterwards.
void destroyBuffer(Device& device, Buffer* buffer);
/// The same once `frame` has completed.
void deferBuffer(Device& device, uint64_t frame, Buffer* buffer);

}  // namespace alpenglow::engine
