// The samplers that tables and maps are read with.
#pragma once

#include "engine/device.h"

namespace alpenglow::engine {

struct SamplerDesc {
  VkFilter filter = VK_FILTER_LINEAR;
  VkSamplerAddressMode addressU = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  VkSamplerAddressMode addressV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  VkSamplerAddressMode addressW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  bool mipmaps = false;  ///< Linear between levels.
  const char* name = "";
};

/// Normalised coordinates, no anisotropy, no compare.
Status createSampler(Device& device, const SamplerDesc& desc, VkSampler* out);

}  // namespace alpenglow::engine
