// Destruction that waits for the GPU: what frame N may still use is destroyed once the host says
// that N has completed.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <mutex>
#include <vector>

#include "engine/memory_block.h"

namespace alpenglow::engine {

class Device;

/// Holds handles until their frame is done. Thread-safe.
class DeletionQueue {
 public:
  explicit DeletionQueue(Device& device) : device_(device) {}
  DeletionQueue(const DeletionQueue&) = delete;
  DeletionQueue& operator=(const DeletionQueue&) = delete;

  /// Destroys the object (a type that Device::destroyObject knows) when a `collect` says that
  /// `frame` has completed. A null handle is ignored. Objects of one frame go in the order in which
  /// they were deferred. Should the list itself find no host memory, the object is kept for ever
  /// and a Warning says so.
  void defer(uint64_t frame, VkObjectType type, uint64_t handle);
  /// The same for a memory block: defer it after everything that is bound to it.
  void defer(uint64_t frame, const MemoryBlock& block);

  /// Destroys what frames up to and including `completed` left behind.
  void collect(uint64_t completed);
  /// Destroys everything: the caller guarantees that the GPU is done with it.
  void destroyAll();
  /// How many objects and blocks are waiting.
  size_t size() const;

 private:
  struct Entry {
    uint64_t frame = 0;
    VkObjectType type = VK_OBJECT_TYPE_UNKNOWN;  ///< UNKNOWN: `block` counts, not `handle`.
    uint64_t handle = 0;
    MemoryBlock block;
  };

  void push(const Entry& entry);
  void destroy(const Entry& entry);

  Device& device_;
  mutable std::mutex mutex_;
  std::vector<Entry> entries_;
};

}  // namespace alpenglow::engine
