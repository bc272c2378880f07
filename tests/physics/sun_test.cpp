// The medium, the terminator and the sun's angles.
#include <numbers>

#include "physics_overloads.h"

namespace alpenglow::test {
namespace {

template <class P>
class SunAndMedium : public testing::Test {};
TYPED_TEST_SUITE(SunAndMedium, Precisions, PrecisionNames);

TYPED_TEST(SunAndMedium, DensitiesAreThoseOfTheModel) {
  using Real = typename TypeParam::Real;
  const Parameters p = preset("earth");
  const auto m = TypeParam::medium(p);
  EXPECT_EQ(rayleighDensity(m, Real(0)), Real(1));
  EXPECT_NEAR(rayleighDensity(m, Real(8000)), std::exp(-1.0), 1e-7);
  EXPECT_NEAR(mieDensity(m, Real(2400)), std::exp(-2.0), 1e-7);
  EXPECT_EQ(absorptionDensity(m, Real(25000)), Real(1));
  EXPECT_NEAR(absorptionDensity(m, Real(17500)), 0.5, 1e-7);
  EXPECT_NEAR(absorptionDensity(m, Real(32500)), 0.5, 1e-7);
  EXPECT_EQ(absorptionDensity(m, Real(9999)), Real(0));
  EXPECT_EQ(absorptionDensity(m, Real(40001)), Real(0));
  const double expected =
      13.5e-6 * std::exp(-20.0 / 8) + 2.22e-5 * std::exp(-20.0 / 1.2) + 1.881e-6 * (1 - 5.0 / 15);
  EXPECT_NEAR(extinction(m, Real(20000))[1], expected, 1e-6 * expected);
}

TYPED_TEST(SunAndMedium, AbsentConstituentsAreNeutral) {
  using Real = typename TypeParam::Real;
  Parameters p = preset("earth");
  p.rayleigh.present = p.mie.present = p.absorption.present = false;
  const auto m = TypeParam::medium(p);
  for (Real h : {Real(0), Real(1), Real(30e3), Real(60e3)}) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(extinction(m, h)[i], Real(0));
    }
  }
}

TYPED_TEST(SunAndMedium, ParallelBeamStepsAtTheHorizon) {
  using Real = typename TypeParam::Real;
  const auto m = TypeParam::medium(preset("earth"));
  for (Real h : {Real(0), Real(2), Real(9000), Real(60e3)}) {
    const Real edge = horizonMu(m, h);
    EXPECT_EQ(sunVisibility(m, h, edge + Real(1e-6)), Real(1)) << h;
    EXPECT_EQ(sunVisibility(m, h, edge - Real(1e-6)), Real(0)) << h;
    EXPECT_EQ(sunVisibility(m, h, Real(1)), Real(1));
    EXPECT_EQ(sunVisibility(m, h, Real(-1)), Real(0));
  }
}

TYPED_TEST(SunAndMedium, DiscSetsSmoothly) {
  using Real = typename TypeParam::Real;
  Parameters p = preset("earth");
  const double radius = 0.2667 * std::numbers::pi / 180;
  p.sunAngularRadius = radius;
  const auto m = TypeParam::medium(p);
  for (Real h : {Real(0), Real(9000)}) {
    const double edge = std::acos(static_cast<double>(horizonMu(m, h)));
    const auto visible = [&](double below) {
      return static_cast<double>(sunVisibility(m, h, static_cast<Real>(std::cos(edge + below))));
    };
    EXPECT_NEAR(visible(0), 0.5, 2e-4);
    EXPECT_NEAR(visible(1.05 * radius), 0.0, 1e-6);
    EXPECT_NEAR(visible(-1.05 * radius), 1.0, 1e-6);
    // Half the radius below: the segment of a circle, (acos x - x sqrt(1 - x^2)) / pi.
    EXPECT_NEAR(visible(0.5 * radius), (std::acos(0.5) - 0.5 * std::sqrt(0.75)) / std::numbers::pi,
                2e-4);
    double before = 1;
    for (double x = -1.2; x <= 1.2; x += 0.05) {
      EXPECT_LE(visible(x * radius), before + 1e-6);
      before = visible(x * radius);
    }
  }
}

TYPED_TEST(SunAndMedium, AnglesAlongARayAreThoseOfVectors) {
  using Real = typename TypeParam::Real;
  const double tolerance = std::is_same_v<Real, float> ? 1e-6 : 1e-13;
  const auto m = TypeParam::medium(preset("earth"));
  const double h = 1000, mu = 0.02, muS = -0.05, azimuth = 2.0;
  const double sinV = std::sqrt(1 - mu * mu), sinS = std::sqrt(1 - muS * muS);
  const double nu = mu * muS + sinV * sinS * std::cos(azimuth);
  for (double t : {1.0, 1e4, 5e5}) {
    const double x = t * sinV, z = 6361e3 + t * mu, r = std::hypot(x, z);
    const Real ht = static_cast<Real>(r - 6360e3);
    EXPECT_NEAR(muAt(m, Real(h), Real(mu), Real(t), ht), (x * sinV + z * mu) / r, tolerance);
    EXPECT_NEAR(muSAt(m, Real(h), Real(muS), Real(nu), Real(t), ht),
                (x * sinS * std::cos(azimuth) + z * muS) / r, tolerance);
  }
}

TYPED_TEST(SunAndMedium, ImpossibleAnglesAreClamped) {
  EXPECT_NEAR(clampNu(typename TypeParam::Real(1), typename TypeParam::Real(0.5),
                      typename TypeParam::Real(0.9)),
              0.5, 1e-6);
}

}  // namespace
}  // namespace alpenglow::test
