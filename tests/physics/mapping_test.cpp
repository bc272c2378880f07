#include <vector>

#include "physics_overloads.h"

namespace alpenglow::test {
namespace {

template <class P>
class Mapping : public testing::Test {};
TYPED_TEST_SUITE(Mapping, Precisions, PrecisionNames);

struct Sizes {
  int r, mu, muS, nu;
};
constexpr Sizes kSizes[] = {{32, 128, 32, 8}, {2, 4, 2, 2}, {17, 66, 33, 5}, {64, 512, 128, 64}};
constexpr double kRadii[] = {10e3, 3389.5e3, 6360e3, 100e6};

/// Texels that a round trip may be off.
template <class Real>
constexpr double slack() {
  return std::is_same_v<Real, float> ? 0.01 : 1e-6;
}

TYPED_TEST(Mapping, ScatteringAltitudesRoundTrip) {
  using Real = typename TypeParam::Real;
  for (double radius : kRadii) {
    const auto m = TypeParam::medium(earthOfRadius(radius));
    for (const Sizes& size : kSizes) {
      const Real n = static_cast<Real>(size.r);
      for (int i = 0; i < size.r; ++i) {
        const Real h = scatteringH(m, texelToU(static_cast<Real>(i), n));
        EXPECT_GE(h, Real(0));
        EXPECT_LE(h, m.thickness);
        const Real texel = insetCoordinate(scatteringUr(m, h), n) * n - Real(0.5);
        EXPECT_NEAR(texel, i, slack<Real>()) << radius;
      }
    }
  }
}

/// The texel that texel j of u_mu comes back as. The paper's halves are linear in the distance d to
/// the ground or the top, from d = 0, so that texels nearer than the nadir (d = h) or the zenith
/// (d = Rt - r) stand for those.
double texelOfDirection(double radius, double thickness, double h, int j, int n) {
  const double last = 0.5 * n - 1;
  const double rho = std::sqrt(h * (2 * radius + h));
  if (2 * j < n) {
    return std::min<double>(j, last * (1 - h / rho));
  }
  const double top = std::sqrt(thickness * (2 * radius + thickness));
  return std::max<double>(j, 0.5 * n + last * (thickness - h) / (rho + top));
}

TYPED_TEST(Mapping, ScatteringDirectionsRoundTripInBothHalves) {
  using Real = typename TypeParam::Real;
  for (double radius : kRadii) {
    const auto m = TypeParam::medium(earthOfRadius(radius));
    for (const Sizes& size : kSizes) {
      const Real n = static_cast<Real>(size.mu);
      for (int i = 1; i < size.r; ++i) {
        const Real h = scatteringH(m, texelToU(static_cast<Real>(i), static_cast<Real>(size.r)));
        for (int j = 0; j < size.mu; ++j) {
          const bool ground = 2 * j < size.mu;
          const Real u = texelToScatteringUmu(static_cast<Real>(j), ground, n);
          const Real mu = scatteringMu(m, h, u, ground);
          ASSERT_TRUE(mu >= Real(-1) && mu <= Real(1)) << mu;
          const Real back = scatteringUmu(m, h, mu, ground);
          const Real texel = scatteringCoordinateMu(back, ground, n) * n - Real(0.5);
          // Half a float's digits are left of a distance near the tangent.
          const double digits = std::is_same_v<Real, float> ? 1e-3 * size.mu : 1e-5;
          EXPECT_NEAR(texel, texelOfDirection(radius, m.thickness, h, j, size.mu), digits)
              << radius << " h " << h << " mu " << mu << " j " << j;
        }
      }
    }
  }
}

TYPED_TEST(Mapping, HalvesMeetAtTheHorizonAndDoNotMix) {
  using Real = typename TypeParam::Real;
  const auto m = TypeParam::medium(preset("earth"));
  const Real n = 128;
  for (double altitude : {0.0, 2.0, 9000.0, 60e3}) {
    const Real h = static_cast<Real>(altitude);
    for (Real mu : {Real(-1), Real(-0.5), horizonMu(m, h), Real(0), Real(1)}) {
      const Real ground = scatteringCoordinateMu(scatteringUmu(m, h, mu, true), true, n);
      const Real sky = scatteringCoordinateMu(scatteringUmu(m, h, mu, false), false, n);
      // Texel centres 0 to 63 and 64 to 127: filtering never reaches across.
      EXPECT_GE(ground, Real(0.5) / n * Real(0.9999));
      EXPECT_LE(ground, Real(63.5) / n * Real(1.0001));
      EXPECT_GE(sky, Real(64.5) / n * Real(0.9999));
      EXPECT_LE(sky, Real(127.5) / n * Real(1.0001));
    }
  }
  // 0 and 1 are the horizon, 1/2 the nadir and the zenith.
  const Real h = 9000;
  EXPECT_NEAR(scatteringUmu(m, h, horizonMu(m, h), true), 0.0, 1e-3);
  EXPECT_NEAR(scatteringUmu(m, h, horizonMu(m, h), false), 1.0, 1e-3);
  EXPECT_NEAR(scatteringMu(m, h, Real(0.5), true), -1.0, 1e-6);
  EXPECT_NEAR(scatteringMu(m, h, Real(0.5), false), 1.0, 1e-6);
  EXPECT_NEAR(scatteringMu(m, h, Real(0), true), horizonMu(m, h), 1e-6);
  EXPECT_NEAR(scatteringMu(m, h, Real(1), false), horizonMu(m, h), 1e-6);
}

TYPED_TEST(Mapping, ScatteringDirectionsOnTheGroundAreDefined) {
  // The paper's ground branch is 0/0 at rho = 0.
  using Real = typename TypeParam::Real;
  const auto m = TypeParam::medium(preset("earth"));
  for (Real mu : {Real(-1), Real(-0.5), Real(-1e-3), Real(-1e-7), Real(0)}) {
    EXPECT_EQ(scatteringUmu(m, Real(0), mu, true), Real(0.5)) << mu;
  }
  for (int j = 0; j < 64; ++j) {
    const Real u = texelToScatteringUmu(static_cast<Real>(j), true, Real(128));
    EXPECT_EQ(scatteringMu(m, Real(0), u, true), Real(-1)) << j;
  }
  // Just above it, the nadir's neighbourhood is continuous.
  EXPECT_NEAR(scatteringUmu(m, Real(1e-3), Real(-1), true), 0.5, 1e-4);
}

TYPED_TEST(Mapping, GroundBranchIsThePapers) {
  // 1/2 + (r mu + sqrt(Delta)) / (2 rho), evaluated where it does not cancel.
  using Real = typename TypeParam::Real;
  const auto m = TypeParam::medium(preset("earth"));
  for (double h : {2.0, 1000.0, 30e3}) {
    for (double mu : {-1.0, -0.5, -0.15}) {
      const double r = 6360e3 + h, rho = std::sqrt(h * (2 * 6360e3 + h));
      const double delta = r * r * mu * mu - rho * rho;
      const double paper = 0.5 + (r * mu + std::sqrt(delta)) / (2 * rho);
      EXPECT_NEAR(scatteringUmu(m, static_cast<Real>(h), static_cast<Real>(mu), true), paper, 1e-5)
          << h << " " << mu;
    }
  }
}

TYPED_TEST(Mapping, SkyBranchIsThePapers) {
  using Real = typename TypeParam::Real;
  const auto m = TypeParam::medium(preset("earth"));
  const double top = std::sqrt(6420e3 * 6420e3 - 6360e3 * 6360e3);
  for (double h : {0.0, 1000.0, 30e3}) {
    for (double mu : {1.0, 0.5, 0.0, -0.01}) {
      const double r = 6360e3 + h, rho = std::sqrt(h * (2 * 6360e3 + h));
      const double delta = r * r * mu * mu - rho * rho;
      if (mu < 0 && delta > 0) {
        continue;  // Hits the ground.
      }
      const double paper = 0.5 - (r * mu - std::sqrt(delta + top * top)) / (2 * rho + 2 * top);
      EXPECT_NEAR(scatteringUmu(m, static_cast<Real>(h), static_cast<Real>(mu), false), paper, 1e-5)
          << h << " " << mu;
    }
  }
}

TYPED_TEST(Mapping, SunAnglesRoundTripAndHoldBelowTheTable) {
  using Real = typename TypeParam::Real;
  for (const Sizes& size : kSizes) {
    const Real n = static_cast<Real>(size.muS);
    for (int i = 0; i < size.muS; ++i) {
      const Real muS = scatteringMuS(texelToU(static_cast<Real>(i), n));
      const Real texel = insetCoordinate(scatteringUmuS(muS), n) * n - Real(0.5);
      EXPECT_NEAR(texel, i, slack<Real>());
    }
  }
  EXPECT_NEAR(scatteringMuS(Real(0)), -0.2, 1e-6);
  EXPECT_NEAR(scatteringMuS(Real(1)), 1.0, 1e-5);
  for (Real muS : {Real(-0.2000001), Real(-0.3), Real(-1)}) {
    EXPECT_EQ(scatteringUmuS(muS), Real(0)) << "held below -0.2";
  }
  for (double muS : {-0.1, 0.0, 0.3, 1.0}) {
    const double paper = (1 - std::exp(-3 * muS - 0.6)) / (1 - std::exp(-3.6));
    EXPECT_NEAR(scatteringUmuS(static_cast<Real>(muS)), paper, 1e-6);
  }
}

TYPED_TEST(Mapping, PhaseAnglesAreLinear) {
  using Real = typename TypeParam::Real;
  EXPECT_EQ(scatteringUnu(Real(-1)), Real(0));
  EXPECT_EQ(scatteringUnu(Real(0)), Real(0.5));
  EXPECT_EQ(scatteringUnu(Real(1)), Real(1));
  EXPECT_EQ(scatteringUnu(std::nextafter(Real(1), Real(2))), Real(1));
}

TYPED_TEST(Mapping, TransmittanceRoundTrips) {
  using Real = typename TypeParam::Real;
  const Sizes sizes[] = {{64, 256, 0, 0}, {2, 2, 0, 0}, {33, 17, 0, 0}};
  for (double radius : kRadii) {
    const auto m = TypeParam::medium(earthOfRadius(radius));
    for (const Sizes& size : sizes) {
      const Real nMu = static_cast<Real>(size.mu), nR = static_cast<Real>(size.r);
      for (int i = 0; i < size.r; ++i) {
        for (int j = 0; j < size.mu; ++j) {
          auto u = transmittanceUv(m, Real(0), Real(0));
          u[0] = texelToU(static_cast<Real>(j), nMu);
          u[1] = texelToU(static_cast<Real>(i), nR);
          const auto hMu = transmittanceHMu(m, u);
          ASSERT_TRUE(hMu[1] >= Real(-1) && hMu[1] <= Real(1)) << hMu[1];
          const auto back = transmittanceUv(m, hMu[0], hMu[1]);
          EXPECT_NEAR(insetCoordinate(back[0], nMu) * nMu - Real(0.5), j, slack<Real>());
          EXPECT_NEAR(insetCoordinate(back[1], nR) * nR - Real(0.5), i, slack<Real>());
        }
      }
    }
  }
}

TYPED_TEST(Mapping, TransmittanceTableHoldsEveryHorizon) {
  using Real = typename TypeParam::Real;
  for (double radius : kRadii) {
    const auto m = TypeParam::medium(earthOfRadius(radius));
    for (double share : {0.0, 0.01, 0.5, 1.0}) {
      const Real h = static_cast<Real>(share) * m.thickness;
      EXPECT_GE(horizonMu(m, h), m.transmittanceMuMin - Real(1e-6)) << radius;
    }
  }
}

TYPED_TEST(Mapping, IrradianceRoundTrips) {
  using Real = typename TypeParam::Real;
  const auto m = TypeParam::medium(preset("earth"));
  for (int n : {2, 16, 64}) {
    const Real count = static_cast<Real>(n);
    for (int i = 0; i < n; ++i) {
      auto u = irradianceUv(m, Real(0), Real(0));
      u[0] = u[1] = texelToU(static_cast<Real>(i), count);
      const auto hMuS = irradianceHMuS(m, u);
      const auto back = irradianceUv(m, hMuS[0], hMuS[1]);
      EXPECT_NEAR(insetCoordinate(back[0], count) * count - Real(0.5), i, slack<Real>());
      EXPECT_NEAR(insetCoordinate(back[1], count) * count - Real(0.5), i, slack<Real>());
    }
  }
  EXPECT_EQ(irradianceUv(m, Real(0), Real(-0.5))[0], Real(0)) << "held below -0.2";
}

}  // namespace
}  // namespace alpenglow::test
