// A frame as the host states it, resolved for the passes.
#pragma once

#include "atmosphere/sky/world.h"

namespace alpenglow::view {

/// Ok, or a sentence for a member of FrameDesc that this version refuses unless it is 0.
Status checkLater(const engine::Device& device, const FrameDesc& desc);

/// Camera 0, light 0 and scale, in the planet frame. The world has been checked. `scene`: extent of the
/// scene's depth, for a camera without a viewport.
FrameState frameState(const FrameDesc& desc, Projection projection, const Spectrum& irradiance,
                      VkExtent2D scene);

CasterSet casterSet(const FrameDesc& desc, const FrameState& state);

/// Warnings that a view reports once each.
enum Warning : uint32_t {
  kWarningDeepCamera = 1u << 0,
  kWarningDarkSun = 1u << 1,
  kWarningOverflow = 1u << 2,
  kWarningBounds = 1u << 3,
};

/// Greatest finite value that a colour format holds; infinity where it has no such limit here.
double greatestValue(VkFormat format);

}  // namespace alpenglow::view
