#include "engine/frame_sets.h"
#include "engine/exceptions.h"

#include <algorithm>
#include <new>

namespace alpenglow::engine {

Status FrameSets::make(const VkDescriptorSetLayoutBinding* bindings, uint32_t count,
                       const char* name) {
  name_ = name;
  count_ = std::min(count, kMostBindings);
  std::copy_n(bindings, count_, bindings_);
  return createSetLayout(device_, bindings_, count_, name_, &layout_);
}

Status FrameSets::next(VkDescriptorSet* out) {
  for (Entry& entry : entries_) {
    if (entry.frame > device_.completed()) continue;
    entry.frame = device_.submitting();
    *out = entry.set;
    return Status::Ok;
  }
  ALPENGLOW_TRY { entries_.reserve(entries_.size() + 1); }
  ALPENGLOW_CATCH_BAD_ALLOC {
    return device_.fail(Status::OutOfHostMemory, VK_SUCCESS, "A frame of %s found no host memory.",
                        name_);
  }
  Entry entry;
  entry.frame = device_.submitting();
  const PoolPart part = {bindings_, count_, 1};
  Status status = createPool(device_, &part, 1, name_, &entry.pool);
  if (status == Status::Ok)
    status = allocateSets(device_, entry.pool, &layout_, 1, name_, &entry.set);
  if (status != Status::Ok) {
    device_.destroyObject(VK_OBJECT_TYPE_DESCRIPTOR_POOL, entry.pool);
    return status;
  }
  entries_.push_back(entry);
  *out = entry.set;
  return Status::Ok;
}

void FrameSets::destroy(uint64_t frame) {
  for (const Entry& entry : entries_)
    device_.deletions().defer(frame, VK_OBJECT_TYPE_DESCRIPTOR_POOL, handleNumber(entry.pool));
  device_.deletions().defer(frame, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, handleNumber(layout_));
}

}  // namespace alpenglow::engine
