#include <cmath>

#include "atmosphere/reference/optical_depth.h"
#include "test_atmospheres.h"

namespace alpenglow::reference {
namespace {

using test::preset;

constexpr Tolerance kFine{1e-12, 0.0};

/// Integral of the tent from the ground to h.
double tentColumn(double center, double half, double h) {
  const auto rise = [&](double x) {  // From the tent's lower foot, x in units of half.
    const double u = std::clamp(x, 0.0, 2.0);
    return u <= 1.0 ? 0.5 * u * u : 1.0 - 0.5 * (2.0 - u) * (2.0 - u);
  };
  return half * (rise((h - center + half) / half) - rise((half - center) / half));
}

TEST(OpticalDepth, VerticalRaysAreClosedForms) {
  for (const char* name : {"earth", "earth-hazy", "mars"}) {
    const Parameters p = preset(name);
    const Medium m = makeMediumF64(p);
    for (double h : {0.0, 2.0, 10e3, 25e3, 39e3}) {
      const auto depth = opticalDepth(m, {h, 1.0, m.thickness - h}, kFine);
      for (uint32_t i = 0; i < kSpectrumSize; ++i) {
        const auto column = [&](double scaleHeight) {
          return scaleHeight * (std::exp(-h / scaleHeight) - std::exp(-m.thickness / scaleHeight));
        };
        double expected = p.rayleigh.scattering_per_m[i] * column(p.rayleigh.scaleHeight_m) +
                          p.mie.extinction_per_m[i] * column(p.mie.scaleHeight_m);
        if (p.absorption.present) {
          const auto& a = p.absorption;
          expected += a.extinction_per_m[i] * (tentColumn(a.center_m, a.halfWidth_m, m.thickness) -
                                               tentColumn(a.center_m, a.halfWidth_m, h));
        }
        EXPECT_NEAR(depth.value[i], expected, 1e-12 * expected) << name << " " << h;
      }
    }
  }
}

TEST(OpticalDepth, HorizontalRayIsABesselFunction) {
  // Without a top the integral of exp(-(sqrt(r^2 + t^2) - r) / H) is r exp(r/H) K_1(r/H). A small
  // planet keeps K_1 in range; its top is 50 scale heights up.
  Parameters p = preset("earth-clear");
  p.bottomRadius_m = 60e3;
  p.topRadius_m = 110e3;
  p.rayleigh.scaleHeight_m = 1e3;
  p.absorption.present = false;
  const Medium m = makeMediumF64(p);
  const auto depth = opticalDepthToTop(m, 0.0, 0.0, kFine);
  const double x = 60.0;
  const double expected =
      p.rayleigh.scattering_per_m[1] * 60e3 * std::exp(x) * std::cyl_bessel_k(1.0, x);
  EXPECT_NEAR(depth.value[1], expected, 1e-11 * expected);
}

TEST(OpticalDepth, HugePlanetIsPlaneParallel) {
  Parameters p = preset("earth");
  p.bottomRadius_m = 1e13;
  p.topRadius_m = 1e13 + 60e3;
  Medium m = makeMediumF64(p);
  const auto vertical = opticalDepth(m, {0.0, 1.0, m.thickness}, kFine);
  for (double mu : {0.9, 0.5, 0.2, 0.1}) {
    const auto slanted = opticalDepthToTop(m, 0.0, mu, kFine);
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      EXPECT_NEAR(slanted.value[i] * mu, vertical.value[i], 1e-7 * vertical.value[i]) << mu;
    }
  }
}

TEST(OpticalDepth, IsTheSameBothWays) {
  const Medium m = makeMediumF64(preset("earth"));
  for (double h : {0.0, 2.0, 500.0, 11e3, 40e3}) {
    for (double mu : {1.0, 0.3, 0.01, 0.0, -0.01, -0.05, -0.4}) {
      const bool ground = physics_f64::rayHitsGround(m, h, mu);
      const double length =
          ground ? physics_f64::distanceToGround(m, h, mu) : physics_f64::distanceToTop(m, h, mu);
      const double end = ground ? 0.0 : m.thickness;
      const double muEnd = physics_f64::muAt(m, h, mu, length, end);
      const auto there = opticalDepth(m, {h, mu, length}, kFine);
      const auto back = opticalDepth(m, {end, -muEnd, length}, kFine);
      for (uint32_t i = 0; i < kSpectrumSize; ++i) {
        EXPECT_NEAR(back.value[i], there.value[i], 1e-9 * there.value[i]) << h << " " << mu;
      }
    }
  }
}

TEST(OpticalDepth, AddsUpAlongARay) {
  const Medium m = makeMediumF64(preset("earth"));
  const double h = 9e3, mu = -0.05;  // Dips to some kilometres and leaves again.
  ASSERT_FALSE(physics_f64::rayHitsGround(m, h, mu));
  const double length = physics_f64::distanceToTop(m, h, mu);
  const auto whole = opticalDepth(m, {h, mu, length}, kFine);
  for (double fraction : {0.01, 0.3, 0.5, 0.99}) {
    const double d = fraction * length;
    const double hd = physics_f64::altitudeAt(m, h, mu, d);
    const auto near = opticalDepth(m, {h, mu, d}, kFine);
    const auto far = opticalDepth(m, {hd, physics_f64::muAt(m, h, mu, d, hd), length - d}, kFine);
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      EXPECT_NEAR(near.value[i] + far.value[i], whole.value[i], 1e-9 * whole.value[i]) << fraction;
    }
  }
}

TEST(OpticalDepth, ThinLayersOfTallAtmospheresAreFound) {
  // A 100 m layer under 800 km of almost nothing: plain adaptive quadrature would never see it.
  Parameters p = preset("earth-fig6");
  p.topRadius_m = p.bottomRadius_m + 800e3;
  p.rayleigh.present = false;
  p.mie.scaleHeight_m = 100.0;
  const Medium m = makeMediumF64(p);
  for (double h : {0.0, 300.0}) {
    const auto depth = opticalDepth(m, {h, 1.0, m.thickness - h}, kFine);
    const double expected = p.mie.extinction_per_m[0] * 100.0 * std::exp(-h / 100.0);
    EXPECT_NEAR(depth.value[0], expected, 1e-11 * expected);
  }
}

TEST(OpticalDepth, BreaksAreSortedAndCoverTheSegment) {
  const Medium m = makeMediumF64(preset("earth"));
  for (double length : {1e-3, 1.0, 1e3, 8e5}) {
    const std::vector<double> breaks = smoothBreaks(m, {9e3, -0.05, length});
    ASSERT_GE(breaks.size(), 2u);
    EXPECT_EQ(breaks.front(), 0.0);
    EXPECT_EQ(breaks.back(), length);
    for (size_t i = 0; i + 1 < breaks.size(); ++i) {
      EXPECT_LT(breaks[i], breaks[i + 1]);
    }
  }
}

}  // namespace
}  // namespace alpenglow::reference
