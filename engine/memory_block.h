// A block of device memory, from vkAllocateMemory or from the host's hook.
#pragma once

#include <alpenglow/types.h>

namespace alpenglow::engine {

/// Plain data; freed with freeBlock (engine/memory.h) or through the deletion queue.
struct MemoryBlock {
  MemoryRange range;
  VkDeviceSize size = 0;
  void* mapped = nullptr;  ///< The first byte of the block when it is host-visible, else null.
};

}  // namespace alpenglow::engine
