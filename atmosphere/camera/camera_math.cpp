#include "atmosphere/camera/camera_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/parameters/query.h"

namespace alpenglow::passes {
namespace {

physics_f64::Spectrum depthToTop(const physics_f64::Medium& medium, double h, double mu) {
  return physics_f64::opticalDepthOfSegment(medium, h, mu,
                                            physics_f64::distanceToTop(medium, h, mu));
}

// When half of the sun's disc has set, the ray to its centre ends on the ground. The visible rest
// of the disc is past the horizon, where depthTowardsTop of shaders/glsl/physics takes twice the
// grazing ray's depth minus that of the part behind the camera.
physics_f64::Spectrum depthTowardsSun(const physics_f64::Medium& medium,
                                      const physics_f64::Ray& ray) {
  if (!ray.hitsGround) return depthToTop(medium, ray.h, ray.mu);
  const physics_f64::Spectrum grazing = depthToTop(medium, 0.0, 0.0);
  const physics_f64::Spectrum rise = depthToTop(medium, ray.h, -ray.mu);
  physics_f64::Spectrum depth = grazing;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    const int c = static_cast<int>(i);
    depth[c] = std::max(2.0 * grazing[c] - rise[c], grazing[c]);
  }
  return depth;
}

}  // namespace

double cameraRadius(const EyeCamera& camera) {
  return std::sqrt(dot(camera.position_m, camera.position_m));
}

double cameraAltitude(const Parameters& parameters, const EyeCamera& camera) {
  return std::max(cameraRadius(camera) - parameters.bottomRadius_m, 0.0);
}

physics_f64::SkyViewParams skyViewParams(const Parameters& parameters, double altitude) {
  const double rg = parameters.bottomRadius_m, r = rg + altitude;
  const double rt = parameters.topRadius_m;
  physics_f64::SkyViewParams view;
  view.horizon = std::atan2(rg, std::sqrt(altitude * (2.0 * rg + altitude)));
  view.span = (r > rt ? std::asin(rt / r) : std::numbers::pi) - view.horizon;
  view.bend = std::clamp(6.0 * std::sqrt(0.5 * std::numbers::pi - view.horizon), 0.06, 10.0);
  return view;
}

void sunAzimuth(const FrameState& draw, double out[3]) {
  const double *position = draw.camera.position_m, *sun = draw.sun.direction;
  const double r = cameraRadius(draw.camera), muS = dot(position, sun) / r;
  for (int i = 0; i < 3; ++i) out[i] = sun[i] - muS * position[i] / r;
  const double sine = std::sqrt(dot(out, out));
  for (int i = 0; i < 3; ++i) out[i] *= sine > 1e-12 ? 1.0 / sine : 0.0;
}

Spectrum sunlight(const Parameters& parameters, const FrameState& draw) {
  const physics_f64::Medium medium = makeMediumF64(parameters);
  const double altitude = cameraAltitude(parameters, draw.camera);
  const double muS = std::clamp(
      dot(draw.camera.position_m, draw.sun.direction) / cameraRadius(draw.camera), -1.0, 1.0);
  const double visible = physics_f64::sunVisibility(medium, altitude, muS);
  Spectrum light;
  if (!(visible > 0.0)) return light;
  ProbeQuery towardsSun;
  towardsSun.altitude_m = altitude;
  towardsSun.zenith = towardsSun.sunZenith = std::acos(muS);
  const ResolvedQuery ray = resolveQuery(medium, towardsSun);
  physics_f64::Spectrum depth(0.0);
  if (!ray.empty) depth = depthTowardsSun(medium, ray.ray);
  for (uint32_t i = 0; i < kSpectrumSize; ++i)
    light[i] = draw.sun.irradiance[i] * visible * std::exp(-depth[static_cast<int>(i)]);
  return light;
}

}  // namespace alpenglow::passes
