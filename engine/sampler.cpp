#include "engine/sampler.h"

#include "engine/structure.h"

namespace alpenglow::engine {

Status createSampler(Device& device, const SamplerDesc& desc, VkSampler* out) {
  *out = VK_NULL_HANDLE;
  auto info = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
  info.magFilter = desc.filter;
  info.minFilter = desc.filter;
  info.mipmapMode = desc.mipmaps ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = desc.addressU;
  info.addressModeV = desc.addressV;
  info.addressModeW = desc.addressW;
  info.maxLod = desc.mipmaps ? VK_LOD_CLAMP_NONE : 0.0f;
  const VkResult result =
      device.vk().CreateSampler(device.handle(), &info, device.allocator(), out);
  if (result < 0) {
    *out = VK_NULL_HANDLE;
    return device.failVk(result, "vkCreateSampler", "sampler", desc.name);
  }
  device.setName(VK_OBJECT_TYPE_SAMPLER, handleNumber(*out), desc.name);
  return Status::Ok;
}

}  // namespace alpenglow::engine
