// Directions: frames, and the lobes that the path tracer samples them from. Each lobe is normalised
// over the sphere and can be evaluated, so that any mixture of them can.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/parameters/physics_cpp.h"

namespace alpenglow::reference {

using Vector = glm::dvec3;

/// The unit vector at cosine `cosine` and azimuth 2 pi u about `axis` (a frame without branches but
/// one, Duff et al. 2017).
inline Vector around(const Vector& axis, double cosine, double u) {
  const double sign = std::copysign(1.0, axis.z);
  const double a = -1.0 / (sign + axis.z);
  const double b = axis.x * axis.y * a;
  const Vector x(1.0 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x);
  const Vector y(b, sign + axis.y * axis.y * a, -axis.y);
  const double sine = std::sqrt(std::max((1.0 - cosine) * (1.0 + cosine), 0.0));
  const double phi = 2.0 * std::numbers::pi * u;
  return glm::normalize(cosine * axis + sine * (std::cos(phi) * x + std::sin(phi) * y));
}

/// Cosine with the density of rayleighPhase(): the root of a cubic.
inline double sampleRayleigh(double u) {
  const double a = 2.0 * (2.0 * u - 1.0);
  const double root = std::cbrt(a + std::sqrt(a * a + 1.0));
  return std::clamp(root - 1.0 / root, -1.0, 1.0);
}

/// Henyey & Greenstein's phase function. Cornette & Shanks' is at most 1.5 times this.
inline double greenstein(double g, double nu) {
  const double a = std::abs(g);
  const double d = (1.0 - a) * (1.0 - a) + 2.0 * a * (1.0 - std::copysign(1.0, g) * nu);
  return (1.0 - a) * (1.0 + a) / (4.0 * std::numbers::pi * d * std::sqrt(d));
}
inline double sampleGreenstein(double g, double u) {
  if (std::abs(g) < 1e-3) return 2.0 * u - 1.0;
  const double s = (1.0 - g * g) / (1.0 - g + 2.0 * g * u);
  return std::clamp((1.0 + g * g - s * s) / (2.0 * g), -1.0, 1.0);
}

/// A frame whose z is up and whose x points towards the sun's azimuth.
struct LocalFrame {
  Vector x, y, z;
  LocalFrame(const Vector& up, const Vector& sun) : z(up) {
    const Vector flat = sun - up * glm::dot(up, sun);
    const double length = glm::length(flat);
    x = length > 1e-9 ? flat / length : around(up, 0.0, 0.0);
    y = glm::cross(z, x);
  }
  Vector direction(double mu, double phi) const {
    const double sine = std::sqrt(std::max((1.0 - mu) * (1.0 + mu), 0.0));
    return glm::normalize(mu * z + sine * (std::cos(phi) * x + std::sin(phi) * y));
  }
  /// Cosine of a direction's azimuth from x.
  double cosAzimuth(const Vector& direction) const {
    const double a = glm::dot(x, direction), b = glm::dot(y, direction);
    const double length = std::sqrt(a * a + b * b);
    return length > 1e-12 ? a / length : 1.0;
  }
};

}  // namespace alpenglow::reference
