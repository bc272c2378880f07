// Positions of a frame's camera and sun, as plain numbers in double.
#pragma once

#include "atmosphere/camera/picture.h"

#include "atmosphere/parameters/physics_cpp.h"

namespace alpenglow::passes {

inline double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Distance from the planet's centre.
double cameraRadius(const EyeCamera& camera);
/// The one subtraction that loses precision, computed in double
/// (shaders/glsl/physics/geometry.glsl); 0 below the ground.
double cameraAltitude(const Parameters& parameters, const EyeCamera& camera);

/// The mapping of a camera's rays to a LUT.
physics_f64::SkyViewParams skyViewParams(const Parameters& parameters, double altitude);

/// Horizontal unit vector towards the sun at the camera; 0 for a sun in the zenith, where any
/// azimuth will do.
void sunAzimuth(const FrameState& draw, double out[3]);

/// Irradiance of the sun on a surface that faces it, at the camera: transmittance by quadrature, 0
/// in the planet's shadow. No division by the sine of the elevation.
Spectrum sunlight(const Parameters& parameters, const FrameState& draw);

}  // namespace alpenglow::passes
