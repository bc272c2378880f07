// Passes in which a host draws its casters, and what placeCaster needs to know of them.
#pragma once

#include "atmosphere/passes/light_shaft_frame.h"
#include "engine/device.h"

namespace alpenglow::passes {

/// What CasterPass::internal points to.
struct CasterTarget {
  engine::Device* device = nullptr;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  const ShadowMapPlace* map = nullptr;  ///< Else metres from the eye.
  const double* eye = nullptr;
  const CasterSet* casters = nullptr;
};

/// Push constants of shaders/glsl/passes/caster_placement.glsl.
inline constexpr VkPushConstantRange kPlaceRange = {VK_SHADER_STAGE_VERTEX_BIT, 0, 48};

/// Sets viewport and scissor, binds the pipeline, places casters at the world's origin until the
/// host calls placeCaster, and calls the host's function. `clipFromOrigin`: column-major, from
/// metres off `origin_m`, both in the planet frame.
void drawCasters(VkCommandBuffer commands, const CasterTarget& target, LightShaftMethod method,
                 const double origin_m[3], const double clipFromOrigin[16], VkPipeline pipeline,
                 const VkRect2D& area, const CasterSet& casters);

}  // namespace alpenglow::passes
