// Descriptor set layouts, exactly sized pools, and a writer without heap.
#pragma once

#include "engine/device.h"

namespace alpenglow::engine {

Status createSetLayout(Device& device, const VkDescriptorSetLayoutBinding* bindings,
                       uint32_t bindingCount, const char* name, VkDescriptorSetLayout* out);

/// `sets` sets of the layout with these bindings.
struct PoolPart {
  const VkDescriptorSetLayoutBinding* bindings = nullptr;
  uint32_t bindingCount = 0;
  uint32_t sets = 0;
};

/// A pool that holds exactly these sets. InvalidArgument when they add up to no set.
Status createPool(Device& device, const PoolPart* parts, uint32_t partCount, const char* name,
                  VkDescriptorPool* out);

/// Allocates `count` sets, one for each layout; they go with their pool. On failure `out` holds
/// nulls.
Status allocateSets(Device& device, VkDescriptorPool pool, const VkDescriptorSetLayout* layouts,
                    uint32_t count, const char* name, VkDescriptorSet* out);

/// Gathers writes to one set. Fixed capacity; `flush` sends them in one vkUpdateDescriptorSets.
class DescriptorWriter {
 public:
  static constexpr uint32_t kCapacity = 24;

  explicit DescriptorWriter(VkDescriptorSet set) : set_(set) {}
  DescriptorWriter(const DescriptorWriter&) = delete;
  DescriptorWriter& operator=(const DescriptorWriter&) = delete;

  /// A combined image sampler.
  DescriptorWriter& sampledImage(uint32_t binding, VkImageView view, VkSampler sampler,
                                 VkImageLayout layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                 uint32_t element = 0);
  /// In VK_IMAGE_LAYOUT_GENERAL.
  DescriptorWriter& storageImage(uint32_t binding, VkImageView view, uint32_t element = 0);
  DescriptorWriter& uniformBuffer(uint32_t binding, VkBuffer buffer, VkDeviceSize offset = 0,
                                  VkDeviceSize range = VK_WHOLE_SIZE);
  DescriptorWriter& dynamicUniformBuffer(uint32_t binding, VkBuffer buffer, VkDeviceSize range);
  DescriptorWriter& storageBuffer(uint32_t binding, VkBuffer buffer, VkDeviceSize offset = 0,
                                  VkDeviceSize range = VK_WHOLE_SIZE);

  /// Sends the writes and empties the writer. InvalidArgument with a sentence when there were more
  /// than kCapacity: then nothing is written.
  Status flush(const Device& device);

 private:
  DescriptorWriter& buffer(uint32_t binding, VkDescriptorType type, VkBuffer buffer,
                           VkDeviceSize offset, VkDeviceSize range);
  DescriptorWriter& image(uint32_t binding, VkDescriptorType type, VkImageView view,
                          VkSampler sampler, VkImageLayout layout, uint32_t element);
  VkWriteDescriptorSet* add(uint32_t binding, VkDescriptorType type, uint32_t element);

  VkDescriptorSet set_;
  VkWriteDescriptorSet writes_[kCapacity];
  VkDescriptorImageInfo images_[kCapacity];
  VkDescriptorBufferInfo buffers_[kCapacity];
  uint32_t count_ = 0;
  uint32_t refused_ = 0;
};

}  // namespace alpenglow::engine
