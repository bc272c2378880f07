// The set by which fragment shaders read an air volume: common/air_volume.glsl.
#pragma once

#include "atmosphere/sky/air_volume.h"

namespace alpenglow::sky {

/// Layouts made here for the same stages are identically defined, so that one set is bound with
/// pipelines of several passes.
Status createAirSetLayout(engine::Device& device, VkShaderStageFlags stages,
                          VkDescriptorSetLayout* out);

/// A pool with one set, of the volume's images.
Status createAirSet(bake::Resources& resources, const AirVolume& volume,
                    VkDescriptorSetLayout layout, VkDescriptorPool* pool, VkDescriptorSet* out);

}  // namespace alpenglow::sky
