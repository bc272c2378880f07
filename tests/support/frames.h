// Frames of tests, given as the passes see them: in the planet frame, with every value stated.
#pragma once

#include <alpenglow/view.h>

#include <algorithm>

#include "atmosphere/camera/picture.h"

namespace alpenglow::testing {

/// What a host would state for it. The sun's irradiance is that of the tables.
inline FrameDesc frameDesc(const FrameState& state, const Tables* tables = nullptr) {
  FrameDesc desc;
  desc.tables = tables;
  Camera& camera = desc.cameras[0];
  std::copy_n(state.camera.position_m, 3, camera.position);
  std::copy_n(state.camera.forward, 3, camera.forward);
  std::copy_n(state.camera.up, 3, camera.up);
  camera.fov = state.camera.fov;
  camera.height = state.camera.height_m;
  camera.nearPlane = state.depth.near_m;
  camera.farPlane = state.depth.far_m;
  camera.viewport = state.viewport;
  std::copy_n(state.sun.direction, 3, desc.lights[0].direction);
  desc.lights[0].discRadius = state.sun.discRadius;
  desc.radianceScale = state.radianceScale;
  return desc;
}

/// beginFrame and recordLuts. Outside rendering scopes.
inline Status recordLuts(View* view, VkCommandBuffer commands, const Tables* tables,
                         const FrameState& state) {
  const Status status = beginFrame(view, frameDesc(state, tables), nullptr);
  return status == Status::Ok ? alpenglow::recordLuts(view, commands) : status;
}

/// beginFrame and recordSky. Inside a rendering scope; a view with a sky-view LUT needs recordLuts
/// of the same frame before.
inline Status recordSky(View* view, VkCommandBuffer commands, const Tables* tables,
                        const FrameState& state) {
  const Status status = beginFrame(view, frameDesc(state, tables), nullptr);
  return status == Status::Ok ? alpenglow::recordSky(view, commands) : status;
}

}  // namespace alpenglow::testing
