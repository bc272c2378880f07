#include "engine/descriptors.h"

#include "engine/structure.h"

namespace alpenglow::engine {
namespace {

constexpr uint32_t kMaxPoolTypes = 11;  // The core types, VK_DESCRIPTOR_TYPE_SAMPLER = 0 and on.

/// Descriptors by type, as vkCreateDescriptorPool wants them.
struct PoolSizes {
  VkDescriptorPoolSize sizes[kMaxPoolTypes] = {};
  uint32_t count = 0;

  void add(VkDescriptorType type, uint32_t descriptors) {
    if (descriptors == 0) return;
    for (uint32_t i = 0; i < count; ++i) {
      if (sizes[i].type == type) {
        sizes[i].descriptorCount += descriptors;
        return;
      }
    }
    if (count < kMaxPoolTypes) sizes[count++] = {type, descriptors};
  }
};

}  // namespace

Status createSetLayout(Device& device, const VkDescriptorSetLayoutBinding* bindings,
                       uint32_t bindingCount, const char* name, VkDescriptorSetLayout* out) {
  *out = VK_NULL_HANDLE;
  auto info = structure<VkDescriptorSetLayoutCreateInfo>(
      VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
  info.bindingCount = bindingCount;
  info.pBindings = bindings;
  const VkResult result =
      device.vk().CreateDescriptorSetLayout(device.handle(), &info, device.allocator(), out);
  if (result < 0) {
    *out = VK_NULL_HANDLE;
    return device.failVk(result, "vkCreateDescriptorSetLayout", "layout", name);
  }
  device.setName(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, handleNumber(*out), name);
  return Status::Ok;
}

Status createPool(Device& device, const PoolPart* parts, uint32_t partCount, const char* name,
                  VkDescriptorPool* out) {
  *out = VK_NULL_HANDLE;
  PoolSizes sizes;
  uint32_t sets = 0;
  for (uint32_t i = 0; i < partCount; ++i) {
    sets += parts[i].sets;
    for (uint32_t j = 0; j < parts[i].bindingCount; ++j) {
      const VkDescriptorSetLayoutBinding& binding = parts[i].bindings[j];
      sizes.add(binding.descriptorType, binding.descriptorCount * parts[i].sets);
    }
  }
  if (sets == 0) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "Descriptor pool \"%s\" is made for 0 sets, but at least 1 is expected.",
                       name);
  }
  auto info = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
  info.maxSets = sets;
  info.poolSizeCount = sizes.count;
  info.pPoolSizes = sizes.sizes;
  const VkResult result =
      device.vk().CreateDescriptorPool(device.handle(), &info, device.allocator(), out);
  if (result < 0) {
    *out = VK_NULL_HANDLE;
    return device.failVk(result, "vkCreateDescriptorPool", "pool", name);
  }
  device.setName(VK_OBJECT_TYPE_DESCRIPTOR_POOL, handleNumber(*out), name);
  return Status::Ok;
}

Status allocateSets(Device& device, VkDescriptorPool pool, const VkDescriptorSetLayout* layouts,
                    uint32_t count, const char* name, VkDescriptorSet* out) {
  for (uint32_t i = 0; i < count; ++i) out[i] = VK_NULL_HANDLE;
  auto info =
      structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
  info.descriptorPool = pool;
  info.descriptorSetCount = count;
  info.pSetLayouts = layouts;
  const VkResult result = device.vk().AllocateDescriptorSets(device.handle(), &info, out);
  if (result < 0) {
    for (uint32_t i = 0; i < count; ++i) out[i] = VK_NULL_HANDLE;
    return device.failVk(result, "vkAllocateDescriptorSets", "sets", name);
  }
  // Sets get no debug name: Mesa (22.3) never frees the name of a set that goes with its pool.
  return Status::Ok;
}

VkWriteDescriptorSet* DescriptorWriter::add(uint32_t binding, VkDescriptorType type,
                                            uint32_t element) {
  if (count_ == kCapacity) {
    ++refused_;
    return nullptr;
  }
  VkWriteDescriptorSet* write = &writes_[count_];
  *write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
  write->dstSet = set_;
  write->dstBinding = binding;
  write->dstArrayElement = element;
  write->descriptorCount = 1;
  write->descriptorType = type;
  return write;
}

DescriptorWriter& DescriptorWriter::image(uint32_t binding, VkDescriptorType type, VkImageView view,
                                          VkSampler sampler, VkImageLayout layout,
                                          uint32_t element) {
  if (VkWriteDescriptorSet* write = add(binding, type, element)) {
    images_[count_] = {sampler, view, layout};
    write->pImageInfo = &images_[count_];
    ++count_;
  }
  return *this;
}

DescriptorWriter& DescriptorWriter::buffer(uint32_t binding, VkDescriptorType type, VkBuffer buffer,
                                           VkDeviceSize offset, VkDeviceSize range) {
  if (VkWriteDescriptorSet* write = add(binding, type, 0)) {
    buffers_[count_] = {buffer, offset, range};
    write->pBufferInfo = &buffers_[count_];
    ++count_;
  }
  return *this;
}

DescriptorWriter& DescriptorWriter::sampledImage(uint32_t binding, VkImageView view,
                                                 VkSampler sampler, VkImageLayout layout,
                                                 uint32_t element) {
  return image(binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, view, sampler, layout, element);
}

DescriptorWriter& DescriptorWriter::storageImage(uint32_t binding, VkImageView view,
                                                 uint32_t element) {
  return image(binding, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, view, VK_NULL_HANDLE,
               VK_IMAGE_LAYOUT_GENERAL, element);
}

DescriptorWriter& DescriptorWriter::uniformBuffer(uint32_t binding, VkBuffer handle,
                                                  VkDeviceSize offset, VkDeviceSize range) {
  return buffer(binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, handle, offset, range);
}

DescriptorWriter& DescriptorWriter::dynamicUniformBuffer(uint32_t binding, VkBuffer handle,
                                                         VkDeviceSize range) {
  return buffer(binding, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, handle, 0, range);
}

DescriptorWriter& DescriptorWriter::storageBuffer(uint32_t binding, VkBuffer handle,
                                                  VkDeviceSize offset, VkDeviceSize range) {
  return buffer(binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, handle, offset, range);
}

Status DescriptorWriter::flush(const Device& device) {
  const uint32_t asked = count_ + refused_;
  const bool fits = refused_ == 0;
  if (fits && count_ > 0) {
    device.vk().UpdateDescriptorSets(device.handle(), count_, writes_, 0, nullptr);
  }
  count_ = 0;
  refused_ = 0;
  if (fits) return Status::Ok;
  return device.fail(Status::InvalidArgument, VK_SUCCESS,
                     "%u descriptors are written at once, but at most %u are expected.", asked,
                     kCapacity);
}

}  // namespace alpenglow::engine
