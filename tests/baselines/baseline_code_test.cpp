// The models' text compiles as C++ in both precisions, and keeps its digits.
#include <gtest/gtest.h>

#include <cmath>

#include "atmosphere/parameters/physics_cpp.h"

#define IN(type) const type&
#define OUT(type) type&
#define ALPENGLOW_FN inline
#define ALPENGLOW_PI 3.14159265358979323846
#define SPECTRUM(value) Spectrum(value)
#define ALPENGLOW_TABLE_READS
#define ALPENGLOW_MULTIPLE_READS
#define ALPENGLOW_RAY_READS

namespace alpenglow::physics_f32 {
#define REAL(literal) static_cast<float>(literal)
#include "tests/baselines/baseline_code.inc"
#undef REAL
}  // namespace alpenglow::physics_f32

namespace alpenglow::physics_f64 {
#define REAL(literal) static_cast<double>(literal)
#include "tests/baselines/baseline_code.inc"
#undef REAL
}  // namespace alpenglow::physics_f64

namespace alpenglow {
namespace {

// Optical depths from those of a metre to those of the horizon.
TEST(BaselineShaders, LightLetOutKeepsItsDigits) {
  for (double x = 1e-9; x < 100.0; x *= 1.3) {
    const double wanted = -std::expm1(-x) / x;
    EXPECT_NEAR(physics_f64::lightLetOut(physics_f64::Spectrum(x))[0], wanted, 3e-9);
    const auto single = physics_f32::lightLetOut(physics_f32::Spectrum(static_cast<float>(x)));
    EXPECT_NEAR(static_cast<double>(single[0]), wanted, 4e-6);
  }
}

// In empty space between a sun of 1 and a black ground the models answer nothing, and no NaN.
TEST(BaselineShaders, AnEmptyMediumScattersNothing) {
  Parameters parameters;
  ASSERT_EQ(findPreset("earth", &parameters, {}), Status::Ok);
  parameters.rayleigh.present = parameters.mie.present = parameters.absorption.present = false;
  parameters.groundAlbedo = {};
  const physics_f64::Medium m = makeMediumF64(parameters);
  const physics_f64::TableShape shape = {256, 64, 0, 0, 32, 128, 32, 1};
  const physics_f64::Ray ray = physics_f64::makeRay(m, 2.0, 0.1, 0.99, 0.5, 0.3);
  EXPECT_EQ(physics_f64::oneilLight(m, shape, ray, ray.extent, 10.0).light[0], 0.0);
  EXPECT_EQ(physics_f64::hillaireLight(m, shape, ray, ray.extent, 32.0).light[0], 0.0);
  EXPECT_EQ(physics_f64::multipleScattering(m, shape, 10.0, 0.5)[0], 0.0);
  EXPECT_EQ(physics_f64::hoffmanPreethamOfRay(m, ray, ray.extent).light[0], 0.0);
  EXPECT_EQ(physics_f64::schafhitzelOfSegment(m, shape, ray, 100.0, physics_f64::Spectrum(1.0))[0],
            0.0);
}

}  // namespace
}  // namespace alpenglow
