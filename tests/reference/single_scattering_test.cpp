#include <cmath>

#include "atmosphere/reference/single_scattering.h"
#include "test_atmospheres.h"

namespace alpenglow::reference {
namespace {

using namespace test;

Spectrum skyOf(const Parameters& p, const ProbeQuery& query, double tolerance = 1e-10) {
  return singleScattering(makeMediumF64(p), query, tolerance).value.skyRadiance;
}

/// A planet so large that its air is plane-parallel, with molecules alone.
Parameters flatAir(double scattering_per_m, double scaleHeight_m) {
  Parameters p = preset("earth-fig6");
  p.mie.present = false;
  p.bottomRadius_m = 1e13;
  p.topRadius_m = 1e13 + 60e3;
  p.rayleigh = {true, {{scattering_per_m, scattering_per_m, scattering_per_m}}, scaleHeight_m};
  return p;
}

TEST(SingleScattering, PlaneParallelMediumIsAClosedForm) {
  for (double beta : {1e-7, 1e-5, 1e-3, 1e-2}) {
    const Parameters p = flatAir(beta, 8000.0);
    const double thickness = p.topRadius_m - p.bottomRadius_m;
    const double depth = beta * 8000.0 * -std::expm1(-thickness / 8000.0);
    const double mu = std::cos(20 * kDegree), muS = std::cos(65 * kDegree);
    const double nu = mu * muS + std::sin(20 * kDegree) * std::sin(65 * kDegree);
    const double k = 1 / mu - 1 / muS;
    const double expected =
        physics_f64::rayleighPhase(nu) / mu * std::exp(-depth / muS) * -std::expm1(-depth * k) / k;
    const Spectrum sky = skyOf(p, rayQuery(0, 20, 65, 0));
    EXPECT_NEAR(sky[0], expected, 1e-7 * expected) << beta;
  }
}

TEST(SingleScattering, ConstantSlabIsAClosedForm) {
  // Density is constant; the sun overhead, looking up: every path to the ground has one length.
  const double beta = 2e-5;
  const Parameters p = flatAir(beta, 1e15);
  const double expected = physics_f64::rayleighPhase(1.0) * beta * 60e3 * std::exp(-beta * 60e3);
  EXPECT_NEAR(skyOf(p, rayQuery(0, 0, 0, 0))[0], expected, 1e-8 * expected);
}

TEST(SingleScattering, TighterToleranceChangesLessThan1e8) {
  const double altitudes[] = {0, 2, 12e3, 59.9e3, 400e3, 36e6};
  const double views[] = {0, 85, 89.95, 90.05, 95, 109.7, 171.3, 180};
  const double sunDirections[] = {0, 75, 90, 95, 101};
  for (const char* name : {"earth", "mars"}) {
    const physics_f64::Medium m = makeMediumF64(preset(name));
    for (double altitude : altitudes) {
      for (double view : views) {
        for (double sun : sunDirections) {
          const ProbeQuery query = rayQuery(altitude, view, sun, 30);
          const ReferenceAnswer coarse = singleScattering(m, query, kRelativeTolerance);
          const ReferenceAnswer fine = singleScattering(m, query, 1e-12);
          SCOPED_TRACE(testing::Message() << name << " " << altitude << " " << view << " " << sun);
          expectClose(coarse.value.skyRadiance, fine.value.skyRadiance, 1e-8, "sky");
          expectClose(coarse.value.transmittance, fine.value.transmittance, 1e-8, "T");
          expectClose(coarse.value.groundRadiance, fine.value.groundRadiance, 1e-8, "ground");
          for (uint32_t i = 0; i < kSpectrumSize; ++i) {
            const double error = coarse.standardError.skyRadiance[i];
            EXPECT_LE(std::abs(coarse.value.skyRadiance[i] - fine.value.skyRadiance[i]),
                      error + 1e-15 * coarse.value.skyRadiance[i]);
            EXPECT_LE(error, 1e-8 * coarse.value.skyRadiance[i]);
          }
        }
      }
    }
  }
}

TEST(SingleScattering, AddsUpAlongARay) {
  // L(x, xo) = L(x, y) + T(x, y) L(y, xo), the second from an observer who stands at y.
  const Parameters p = preset("earth");
  const physics_f64::Medium m = makeMediumF64(p);
  const ProbeQuery all = rayQuery(9000, 92.5, 85, 0);
  const double r = p.bottomRadius_m + all.altitude_m;
  for (double d : {10.0, 5e3, 280e3, 600e3}) {
    ProbeQuery near = all;
    near.bounded = true;
    near.distance_m = d;
    // In the plane of view and sun: turning by `turn` about the planet's centre takes x to y.
    const double x = d * std::sin(all.zenith), z = r + d * std::cos(all.zenith);
    const double turn = std::atan2(x, z);
    ProbeQuery far = all;
    far.altitude_m = physics_f64::altitudeAt(m, all.altitude_m, std::cos(all.zenith), d);
    far.zenith = all.zenith - turn;
    far.sunZenith = all.sunZenith - turn;
    const ReferenceAnswer whole = singleScattering(m, all, 1e-11);
    const ReferenceAnswer first = singleScattering(m, near, 1e-11);
    const ReferenceAnswer second = singleScattering(m, far, 1e-11);
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      const double t = first.value.transmittance[i];
      const double sum = first.value.skyRadiance[i] + t * second.value.skyRadiance[i];
      EXPECT_NEAR(sum, whole.value.skyRadiance[i], 1e-8 * sum) << d;
      EXPECT_NEAR(t * second.value.transmittance[i], whole.value.transmittance[i], 1e-9) << d;
    }
  }
}

TEST(SingleScattering, ShadowEndsWhereGeometrySaysSo) {
  // Straight up under a sun 6 degrees down, the shadow ends at Rg (1 / cos 6 - 1) = 35.03 km.
  const Parameters p = preset("earth");
  const double edge = p.bottomRadius_m * (1 / std::cos(6 * kDegree) - 1);
  expectAll(skyOf(p, rayQuery(0, 0, 96, 0, edge - 0.001)), 0.0, "below the edge");
  const Spectrum above = skyOf(p, rayQuery(0, 0, 96, 0, edge + 1.0));
  EXPECT_GT(above[0], 0.0);
  // The first metre of light has no curve yet: twice the length, twice the light.
  const Spectrum twice = skyOf(p, rayQuery(0, 0, 96, 0, edge + 2.0));
  EXPECT_NEAR(twice[0] / above[0], 2.0, 0.01);
}

TEST(SingleScattering, NightIsExactlyDark) {
  const Parameters p = preset("earth");
  for (double view : {0.0, 60.0, 90.0, 120.0}) {
    expectAll(skyOf(p, rayQuery(2, view, 150, 180)), 0.0, "sky");
  }
}

TEST(SingleScattering, DiscSoftensTheTerminatorOnly) {
  const Parameters sharp = preset("earth");
  Parameters tiny = sharp, sun = sharp;
  tiny.sunAngularRadius = 1e-7;
  sun.sunAngularRadius = 0.2667 * kDegree;
  for (double sunZenith : {60.0, 90.0, 96.0}) {
    const ProbeQuery query = rayQuery(2, 45, sunZenith, 30);
    expectClose(skyOf(tiny, query), skyOf(sharp, query), 1e-4, "tiny disc");
    expectClose(skyOf(sun, query), skyOf(sharp, query), 0.05, "disc");
  }
  expectClose(skyOf(sun, rayQuery(2, 45, 60, 30)), skyOf(sharp, rayQuery(2, 45, 60, 30)), 1e-7,
              "the whole disc is up");
  // In the last 0.2 degrees of the shadow only a disc gives light.
  const double edge = sharp.bottomRadius_m * (1 / std::cos(6 * kDegree) - 1);
  const ProbeQuery below = rayQuery(0, 0, 96, 0, 0.99 * edge);
  EXPECT_EQ(skyOf(sharp, below)[0], 0.0);
  EXPECT_GT(skyOf(sun, below)[0], 0.0);
}

TEST(SingleScattering, ExtremeMediaStayFiniteAndOrdered) {
  struct Extreme {
    double radius, thickness, scaleHeight, beta, g;
  };
  const Extreme extremes[] = {{10e3, 300e3, 50e3, 1e-6, 0.99},
                              {60e3, 20e3, 2e3, 1e-4, -0.99},
                              {100e6, 2e6, 50e3, 1e-5, 0.9},
                              {6360e3, 800e3, 100.0, 1e-3, 0.76},
                              {6360e3, 60e3, 1200.0, 1e-1, 0.99}};
  for (const Extreme& e : extremes) {
    Parameters p = preset("earth");
    p.bottomRadius_m = e.radius;
    p.topRadius_m = e.radius + e.thickness;
    p.mie.scaleHeight_m = p.rayleigh.scaleHeight_m = e.scaleHeight;
    p.mie.scattering_per_m = {{e.beta, e.beta, e.beta}};
    p.mie.extinction_per_m = {{1.1 * e.beta, 1.1 * e.beta, 1.1 * e.beta}};
    p.mie.asymmetry = e.g;
    for (double altitude : {0.0, 0.5 * e.thickness, 3 * e.radius}) {
      for (double view : {0.0, 89.99, 90.0, 90.01, 135.0, 165.6, 180.0}) {
        for (double sun : {0.0, 89.9, 95.0, 120.0}) {
          for (double azimuth : {0.0, 180.0}) {
            SCOPED_TRACE(testing::Message() << e.radius << " " << altitude << " " << view << " "
                                            << sun << " " << azimuth);
            ReferenceAnswer a;
            const ProbeQuery query = rayQuery(altitude, view, sun, azimuth);
            ASSERT_EQ(referenceSingleScattering(p, query, &a, {}), Status::Ok);
            for (uint32_t i = 0; i < kSpectrumSize; ++i) {
              EXPECT_TRUE(std::isfinite(a.value.skyRadiance[i]));
              EXPECT_GE(a.value.skyRadiance[i], 0.0);
              EXPECT_GE(a.value.transmittance[i], 0.0);
              EXPECT_LE(a.value.transmittance[i], 1.0);
              EXPECT_LE(a.standardError.skyRadiance[i], 1e-7 * a.value.skyRadiance[i]);
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace alpenglow::reference
