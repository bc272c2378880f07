// The set by which fragment shaders read an air volume: common/air_volume.glsl.
#pragma once

#include "atmosphere/sky/air_volume.h"

namespace alpenglow::sky {

/// Layouts made here are identically defined, so that one set serves pipelines of several rooms.
Status createAirSetLayout(engine::Device& device, VkDescriptorSetLayout* out);

/// A pool with one set, of the volume's images.
Status createAirSet(bake::Resources& resources, const AirVolume& volume,
                    VkDescriptorSetLayout layout, VkDescriptorPool* pool, VkDescriptorSet* out);

}  // namespace alpenglow::sky
