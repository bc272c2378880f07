#include "atmosphere/view/frame.h"

#include <algorithm>
#include <limits>

#include "atmosphere/sky/camera_math.h"

namespace alpenglow::view {
namespace {

constexpr double kPi = 3.14159265358979323846;

bool isZero(const double* values, size_t count) {
  return std::all_of(values, values + count, [](double value) { return value == 0.0; });
}

Status later(const engine::Device& device, const char* member, const char* rule) {
  return device.fail(Status::Unsupported, VK_SUCCESS,
                     "FrameDesc::%s, but this version expects %s.", member, rule);
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

FrameState frameState(const FrameDesc& desc, Projection projection, const Spectrum& irradiance,
                      VkExtent2D scene) {
  const sky::Placement placement(desc.world);
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
    casters.bounds = planetBox(sky::Placement(desc.world), desc.casters.bounds);
    return casters;
  }
  // Nothing casts: an empty map of a metre about the camera.
  std::copy_n(state.camera.position_m, 3, casters.bounds.center_m);
  for (int i = 0; i < 3; ++i) casters.bounds.halfAxes_m[i][i] = 1.0;
  return casters;
}

double greatestValue(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R16G16B16_SFLOAT:
    case VK_FORMAT_R16G16B16A16_SFLOAT:
      return 65504.0;
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:
      return 64512.0;  // Of the ten-bit channel.
    default:
      return std::numeric_limits<double>::infinity();
  }
}

}  // namespace alpenglow::view
