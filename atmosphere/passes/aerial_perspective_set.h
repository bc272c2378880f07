// The set by which fragment shaders read an aerial-perspective LUT:
// common/aerial_perspective_lut.glsl.
#pragma once

#include "atmosphere/passes/aerial_perspective_lut.h"

namespace alpenglow::passes {

/// Layouts made here for the same stages are identically defined, so that one set is bound with
/// pipelines of several passes.
Status createAerialPerspectiveSetLayout(engine::Device& device, VkShaderStageFlags stages,
                                        VkDescriptorSetLayout* out);

/// A pool with one set, of the LUT's images.
Status createAerialPerspectiveSet(tables::Resources& resources, const AerialPerspectiveLut& volume,
                                  VkDescriptorSetLayout layout, VkDescriptorPool* pool,
                                  VkDescriptorSet* out);

}  // namespace alpenglow::passes
