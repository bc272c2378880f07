#include "atmosphere/view/frame.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/camera/camera_math.h"

namespace alpenglow::view {
namespace {

constexpr double kPi = 3.14159265358979323846;

bool isZero(const double* values, size_t count) {
  return std::all_of(values, values + count, [](double value) { return value == 0.0; });
}

Status later(const engine::Device& device, const char* member, const char* rule) {
  return device.fail(Status::Unsupported, VK_SUCCESS, "FrameDesc::%s, but this version expects %s.",
                     member, rule);
}

}  // namespace

Status checkLater(const engine::Device& device, const FrameDesc& desc) {
  for (uint32_t i = 1; i < kMaxCameras; ++i)
    if (!isZero(desc.cameras[i].forward, 3))
      return later(device, "cameras has a camera beyond 0", "one, cameras[0]");
  for (uint32_t i = 1; i < kMaxLights; ++i)
    if (!isZero(desc.lights[i].direction, 3))
      return later(device, "lights has a light beyond 0", "one, lights[0]");
  const Camera& camera = desc.cameras[0];
  const Light& light = desc.lights[0];
  if (!isZero(camera.tangents, 4)) return later(device, "cameras[0].tangents is given", "0");
  if (!isZero(camera.jitter, 2)) return later(device, "cameras[0].jitter is given", "0");
  if (!isZero(light.litFrom, 3)) return later(device, "lights[0].litFrom is given", "0");
  if (light.shadowMap != nullptr) return later(device, "lights[0].shadowMap is given", "null");
  if (light.clouds != nullptr) return later(device, "lights[0].clouds is given", "null");
  if (desc.horizon != nullptr || desc.horizonCount != 0)
    return later(device, "horizon is given", "null");
  return Status::Ok;
}

Status checkWorld(const engine::Device& device, const World& world) {
  for (const double value : world.origin_m) {
    if (std::abs(value) < 1e15) continue;  // False for NaN too.
    return device.fail(
        Status::InvalidArgument, VK_SUCCESS,
        "World::origin_m has a value of %g, but each must be finite and within 1e15 m "
        "of the planet's centre.",
        value);
  }
  const passes::Placement placement(world);
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const double product = passes::dot(placement.axes[i], placement.axes[j]);
      if (std::abs(product - (i == j ? 1.0 : 0.0)) < 1e-4) continue;
      return device.fail(Status::InvalidArgument, VK_SUCCESS,
                         "World::axes has axes %d and %d with the scalar product %g, but needs "
                         "orthonormal ones, or all 0 for the planet frame.",
                         i, j, product);
    }
  }
  if (world.metersPerUnit != 0.0 && world.metersPerUnit != 1.0) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "World::metersPerUnit is %g, but must be 0 or 1 in this version.",
                       world.metersPerUnit);
  }
  if (world.equatorialRadius_m != 0.0 || world.polarRadius_m != 0.0) {
    return device.fail(
        Status::Unsupported, VK_SUCCESS,
        "World::equatorialRadius_m is %g and polarRadius_m %g, but both must be 0 in "
        "this version: altitudes are above the sphere.",
        world.equatorialRadius_m, world.polarRadius_m);
  }
  return Status::Ok;
}

FrameState frameState(const FrameDesc& desc, Projection projection, const Spectrum& irradiance,
                      VkExtent2D scene) {
  const passes::Placement placement(desc.world);
  const Camera& camera = desc.cameras[0];
  const Light& light = desc.lights[0];
  FrameState state;
  placement.toPlanet(camera.position, state.camera.position_m);
  placement.directionToPlanet(camera.forward, state.camera.forward);
  placement.directionToPlanet(camera.up, state.camera.up);
  state.camera.fov = camera.fov != 0.0                   ? camera.fov
                     : projection == Projection::Fisheye ? kPi
                                                         : kPi / 3.0;
  state.camera.height_m = camera.height;
  placement.directionToPlanet(light.direction, state.sun.direction);
  state.sun.discRadius = light.discRadius;
  for (uint32_t i = 0; i < kSpectrumSize; ++i)
    state.sun.irradiance[i] = irradiance[i] * (1.0 - light.dimming);
  state.radianceScale = desc.radianceScale;
  state.viewport = camera.viewport;
  if (state.viewport.extent.width == 0 && state.viewport.extent.height == 0)
    state.viewport.extent = scene;
  state.depth = {camera.nearPlane, camera.farPlane};
  return state;
}

CasterSet casterSet(const FrameDesc& desc, const FrameState& state) {
  CasterSet casters;
  casters.world = desc.world;
  casters.draw = desc.casters.draw;
  casters.user = desc.casters.user;
  casters.version = desc.casters.version;
  if (casters.draw != nullptr) {
    casters.bounds = planetBox(passes::Placement(desc.world), desc.casters.bounds);
    return casters;
  }
  // Nothing casts, and no map is drawn; the place of one, a metre about the camera.
  std::copy_n(state.camera.position_m, 3, casters.bounds.center_m);
  for (int i = 0; i < 3; ++i) casters.bounds.halfAxes_m[i][i] = 1.0;
  return casters;
}

}  // namespace alpenglow::view
