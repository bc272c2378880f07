#include "atmosphere/sky/camera_math.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace alpenglow::sky {

double cameraRadius(const Camera& camera) {
  return std::sqrt(dot(camera.position_m, camera.position_m));
}

double cameraAltitude(const Parameters& parameters, const Camera& camera) {
  return std::max(cameraRadius(camera) - parameters.bottomRadius_m, 0.0);
}

physics_f64::SliceView sliceView(const Parameters& parameters, double altitude) {
  const double rg = parameters.bottomRadius_m, r = rg + altitude;
  const double rt = parameters.topRadius_m;
  physics_f64::SliceView view;
  view.horizon = std::atan2(rg, std::sqrt(altitude * (2.0 * rg + altitude)));
  view.span = (r > rt ? std::asin(rt / r) : std::numbers::pi) - view.horizon;
  view.bend = std::clamp(6.0 * std::sqrt(0.5 * std::numbers::pi - view.horizon), 0.06, 10.0);
  return view;
}

void sunAzimuth(const SkyDraw& draw, double out[3]) {
  const double *position = draw.camera.position_m, *sun = draw.sun.direction;
  const double r = cameraRadius(draw.camera), muS = dot(position, sun) / r;
  for (int i = 0; i < 3; ++i) out[i] = sun[i] - muS * position[i] / r;
  const double sine = std::sqrt(dot(out, out));
  for (int i = 0; i < 3; ++i) out[i] *= sine > 1e-12 ? 1.0 / sine : 0.0;
}

}  // namespace alpenglow::sky
