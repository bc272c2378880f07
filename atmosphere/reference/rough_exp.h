// An exponential for what only guides the sampling, several times as fast as std::exp and free of
// branches, so that loops over channels become vectors.
#pragma once

#include <bit>
#include <cstdint>

#include "atmosphere/parameters/physics_cpp.h"

namespace alpenglow::reference {

/// exp(x) for x <= 1 within 2e-4 of itself, as a test has it; exp(-700) for what is below.
inline double roughExp(double x) {
  const double exponent = (x < -700.0 ? -700.0 : x) * 1.4426950408889634;
  const double shifted = exponent + 1023.0;
  const auto whole = static_cast<int64_t>(shifted);
  const double f = shifted - static_cast<double>(whole);
  // 2^f on [0, 1], exact at both ends.
  const double power = 1.0 + f * (0.6951786 + f * (0.2261622 + f * 0.0786592));
  return std::bit_cast<double>(whole << 52) * power;
}

inline physics_f64::Spectrum roughExp(const physics_f64::Spectrum& x) {
  return {roughExp(x.x), roughExp(x.y), roughExp(x.z)};
}

}  // namespace alpenglow::reference
