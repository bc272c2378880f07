// Where a frame's camera and sun stand, as plain numbers in double.
#pragma once

#include <alpenglow/view.h>

#include "atmosphere/model/physics_cpp.h"

namespace alpenglow::sky {

inline double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Distance from the planet's centre.
double cameraRadius(const Camera& camera);
/// The one subtraction that loses digits, taken in double (shaders/glsl/physics/geometry.glsl); 0
/// below the ground.
double cameraAltitude(const Parameters& parameters, const Camera& camera);

/// How a camera's rays lie in a slice.
physics_f64::SliceView sliceView(const Parameters& parameters, double altitude);

/// Horizontal unit vector towards the sun at the camera; 0 for a sun in the zenith, towards which
/// no azimuth is the sun's, and any will do.
void sunAzimuth(const SkyDraw& draw, double out[3]);

}  // namespace alpenglow::sky
