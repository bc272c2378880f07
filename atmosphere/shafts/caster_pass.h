// What placeCaster needs to know of the pass that a host draws its casters in.
#pragma once

#include "atmosphere/shafts/shaft_frame.h"
#include "engine/device.h"

namespace alpenglow {

inline namespace v1 {

struct CasterPass {
  engine::Device* device = nullptr;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  const shafts::SunMapPlace* map = nullptr;  ///< Else metres from the eye.
  const double* eye = nullptr;
};

}  // namespace v1

namespace shafts {

/// Push constants of place.glsl.
inline constexpr VkPushConstantRange kPlaceRange = {VK_SHADER_STAGE_VERTEX_BIT, 0, 48};

/// Sets viewport and scissor, binds, places casters at the planet's centre until the host says
/// otherwise, and calls it.
void drawCasters(const CasterPass& pass, VkPipeline pipeline, const VkRect2D& area,
                 const Casters& casters);

}  // namespace shafts
}  // namespace alpenglow
