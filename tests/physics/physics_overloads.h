// The physics in both precisions under one name, so that a test's template runs on either:
// functions that take a medium are found by its type, the others are overloaded by their numbers'
// type.
#pragma once

#include <alpenglow/parameters.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "atmosphere/parameters/physics_cpp.h"

namespace alpenglow::test {

using physics_f32::clampNu, physics_f64::clampNu;
using physics_f32::insetCoordinate, physics_f64::insetCoordinate;
using physics_f32::miePhase, physics_f64::miePhase;
using physics_f32::rayleighPhase, physics_f64::rayleighPhase;
using physics_f32::scatteringCoordinateMu, physics_f64::scatteringCoordinateMu;
using physics_f32::scatteringMuS, physics_f64::scatteringMuS;
using physics_f32::scatteringUmuS, physics_f64::scatteringUmuS;
using physics_f32::scatteringUnu, physics_f64::scatteringUnu;
using physics_f32::texelToScatteringUmu, physics_f64::texelToScatteringUmu;
using physics_f32::texelToU, physics_f64::texelToU;

struct InFloat {
  using Real = float;
  using Medium = physics_f32::Medium;
  static Medium medium(const Parameters& p) { return makeMediumF32(p); }
};

struct InDouble {
  using Real = double;
  using Medium = physics_f64::Medium;
  static Medium medium(const Parameters& p) { return makeMediumF64(p); }
};

using Precisions = testing::Types<InFloat, InDouble>;

struct PrecisionNames {
  template <class P>
  static std::string GetName(int) {
    return std::is_same_v<P, InFloat> ? "Float" : "Double";
  }
};

inline Parameters preset(const char* name) {
  Parameters p;
  EXPECT_EQ(findPreset(name, &p, {}), Status::Ok) << name;
  return p;
}

/// Earth with another planet's size: thickness and scale heights stay.
inline Parameters earthOfRadius(double radius_m) {
  Parameters p = preset("earth");
  p.topRadius_m += radius_m - p.bottomRadius_m;
  p.bottomRadius_m = radius_m;
  return p;
}

}  // namespace alpenglow::test
