#include "engine/deletion_queue.h"

#include <cinttypes>
#include <new>

#include "engine/device.h"
#include "engine/exceptions.h"
#include "engine/memory.h"

namespace alpenglow::engine {

void DeletionQueue::defer(uint64_t frame, VkObjectType type, uint64_t handle) {
  if (handle == 0) return;
  Entry entry;
  entry.frame = frame;
  entry.type = type;
  entry.handle = handle;
  push(entry);
}

void DeletionQueue::defer(uint64_t frame, const MemoryBlock& block) {
  if (block.range.memory == VK_NULL_HANDLE) return;
  Entry entry;
  entry.frame = frame;
  entry.block = block;
  push(entry);
}

void DeletionQueue::push(const Entry& entry) {
  ALPENGLOW_TRY {
    const std::lock_guard<std::mutex> lock(mutex_);
    entries_.push_back(entry);
  }
  ALPENGLOW_CATCH_BAD_ALLOC {
    // The GPU may still use it, so it must be leaked.
    device_.notice(Severity::Warning,
                   "There is no host memory to defer the destruction of an object until frame "
                   "%" PRIu64 " completes, so it is never destroyed.",
                   entry.frame);
  }
}

void DeletionQueue::destroy(const Entry& entry) {
  if (entry.type != VK_OBJECT_TYPE_UNKNOWN) {
    device_.destroyObject(entry.type, entry.handle);
    return;
  }
  MemoryBlock block = entry.block;
  freeBlock(device_, &block);
}

void DeletionQueue::collect(uint64_t completed) {
  const std::lock_guard<std::mutex> lock(mutex_);
  // Views have frames of their own, so the numbers needn't rise from entry to entry.
  size_t kept = 0;
  for (size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].frame <= completed) {
      destroy(entries_[i]);
    } else {
      entries_[kept++] = entries_[i];
    }
  }
  entries_.resize(kept);
}

void DeletionQueue::destroyAll() { collect(UINT64_MAX); }

size_t DeletionQueue::size() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return entries_.size();
}

}  // namespace alpenglow::engine
