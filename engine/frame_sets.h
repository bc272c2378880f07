// Descriptor sets whose contents change from frame to frame: one for each frame in flight, reused
// when its frame has completed.
#pragma once

#include <vector>

#include "engine/descriptors.h"

namespace alpenglow::engine {

class FrameSets {
 public:
  static constexpr uint32_t kMostBindings = 8;

  explicit FrameSets(Device& device) : device_(device) {}
  FrameSets(const FrameSets&) = delete;
  FrameSets& operator=(const FrameSets&) = delete;

  Status make(const VkDescriptorSetLayoutBinding* bindings, uint32_t count, const char* name);
  /// Of the frame being recorded; write all of its bindings. A frame may take several.
  Status next(VkDescriptorSet* out);
  void destroy(uint64_t frame);
  VkDescriptorSetLayout layout() const { return layout_; }

 private:
  struct Entry {
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
    uint64_t frame = 0;
  };

  Device& device_;
  const char* name_ = "";
  VkDescriptorSetLayoutBinding bindings_[kMostBindings] = {};
  uint32_t count_ = 0;
  VkDescriptorSetLayout layout_ = VK_NULL_HANDLE;
  std::vector<Entry> entries_;
};

}  // namespace alpenglow::engine
