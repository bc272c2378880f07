// A frame as the host states it, resolved for the passes.
#pragma once

#include "atmosphere/camera/world.h"
#include "engine/device.h"

namespace alpenglow::view {

/// Ok, or a sentence for a member of FrameDesc that this version refuses unless it is 0.
Status checkLater(const engine::Device& device, const FrameDesc& desc);

/// Ok, or a sentence that names the wrong member of FrameDesc::world.
Status checkWorld(const engine::Device& device, const World& world);

/// Camera 0, light 0 and scale, in the planet frame. The world has been checked. `scene`: extent of
/// the scene's depth, for a camera without a viewport.
FrameState frameState(const FrameDesc& desc, Projection projection, const Spectrum& irradiance,
                      VkExtent2D scene);

CasterSet casterSet(const FrameDesc& desc, const FrameState& state);

}  // namespace alpenglow::view
