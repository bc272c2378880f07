#include <glm/gtc/packing.hpp>
#include <vector>

#include "atmosphere/reference/optical_depth.h"
#include "physics_overloads.h"

namespace alpenglow::test {
namespace {

template <class P>
class OpticalDepth : public testing::Test {};
TYPED_TEST_SUITE(OpticalDepth, Precisions, PrecisionNames);

struct View {
  double h, mu;
};
const View kViews[] = {{0, 1},       {0, 0.3},      {0, 0.01},     {2, 0},          {2, -0.5},
                       {1000, 0.05}, {9000, -0.05}, {30e3, -0.09}, {59.9e3, -0.13}, {59.9e3, -0.9}};

template <class Medium, class Real>
Real lengthOf(const Medium& m, Real h, Real mu) {
  return rayHitsGround(m, h, mu) ? distanceToGround(m, h, mu) : distanceToTop(m, h, mu);
}

TYPED_TEST(OpticalDepth, TransmittanceLiesBetweenZeroAndOneAndFalls) {
  using Real = typename TypeParam::Real;
  for (const char* name : {"earth", "earth-hazy", "mars"}) {
    const auto m = TypeParam::medium(preset(name));
    for (const View& view : kViews) {
      const Real h = static_cast<Real>(view.h), mu = static_cast<Real>(view.mu);
      const Real length = lengthOf(m, h, mu);
      Real before = 1;
      for (Real fraction : {Real(0), Real(0.001), Real(0.1), Real(0.5), Real(1)}) {
        const Real t = std::exp(-opticalDepthOfSegment(m, h, mu, fraction * length)[2]);
        EXPECT_GE(t, Real(0)) << name;
        EXPECT_LE(t, before * Real(1.00001)) << name << " " << view.h << " " << view.mu;
        before = t;
      }
      EXPECT_EQ(opticalDepthOfSegment(m, h, mu, Real(0))[2], Real(0));
    }
  }
}

TYPED_TEST(OpticalDepth, TransmittanceMultipliesAlongARay) {
  using Real = typename TypeParam::Real;
  for (const char* name : {"earth-fig6", "mars"}) {
    const auto m = TypeParam::medium(preset(name));
    for (const View& view : kViews) {
      const Real h = static_cast<Real>(view.h), mu = static_cast<Real>(view.mu);
      const Real length = lengthOf(m, h, mu);
      const Real whole = std::exp(-opticalDepthOfSegment(m, h, mu, length)[1]);
      for (Real fraction : {Real(0.05), Real(0.3), Real(0.7)}) {
        const Real d = fraction * length;
        const Real hd = altitudeAt(m, h, mu, d);
        const Real muD = muAt(m, h, mu, d, hd);
        const Real near = std::exp(-opticalDepthOfSegment(m, h, mu, d)[1]);
        const Real far = std::exp(-opticalDepthOfSegment(m, hd, muD, length - d)[1]);
        // 48 nodes on an exponential: the rule, not the rounding, is what is left.
        EXPECT_NEAR(near * far, whole, 1e-3 * whole + 1e-6)
            << name << " " << view.h << " " << view.mu;
      }
    }
  }
}

TYPED_TEST(OpticalDepth, ShortSegmentsKeepTheirDigits) {
  // 1 - T of a kilometre at 2 m altitude, which a quotient of tabulated values loses.
  using Real = typename TypeParam::Real;
  const Parameters p = preset("earth");
  const auto m = TypeParam::medium(p);
  const auto exactMedium = makeMediumF64(p);
  for (double mu : {0.5, 0.01, 0.0, -0.0005}) {
    for (double d : {1.0, 100.0, 1000.0}) {
      const Real value =
          opticalDepthOfSegment(m, Real(2), static_cast<Real>(mu), static_cast<Real>(d))[2];
      const auto exact = reference::opticalDepth(
          exactMedium, {2.0, static_cast<double>(static_cast<Real>(mu)), d}, {1e-12, 0.0});
      EXPECT_NEAR(value, exact.value[2], 2e-6 * exact.value[2]) << mu << " " << d;
    }
  }
}

TEST(OpticalDepthInFloat, HalfFloatsOfTheLogarithmKeepTransmittance) {
  // Near 11.5, the logarithm of depth 1, half floats have steps of 2^-7.
  for (double depth = 1e-6; depth < 50.0; depth *= 1.01) {
    const auto stored = physics_f32::encodeOpticalDepth(glm::vec3(static_cast<float>(depth)));
    const glm::vec3 half(glm::unpackHalf1x16(glm::packHalf1x16(stored[0])));
    const double transmittance = std::exp(-double(physics_f32::decodeOpticalDepth(half)[0]));
    EXPECT_NEAR(transmittance, std::exp(-depth), 1.5e-3) << depth;
  }
}

TYPED_TEST(OpticalDepth, SegmentsAgreeWithTheReference) {
  using Real = typename TypeParam::Real;
  for (const char* name : {"earth", "earth-fig6", "earth-clear", "mars"}) {
    const Parameters p = preset(name);
    const auto m = TypeParam::medium(p);
    const auto exactMedium = makeMediumF64(p);
    const double tolerance = 1e-4;
    for (const View& view : kViews) {
      const Real h = static_cast<Real>(view.h), mu = static_cast<Real>(view.mu);
      const Real length = lengthOf(m, h, mu);
      const auto exact = reference::opticalDepth(
          exactMedium,
          {static_cast<double>(h), static_cast<double>(mu), static_cast<double>(length)},
          {1e-12, 0.0});
      for (int i = 0; i < 3; ++i) {
        const double expected = std::exp(-exact.value[static_cast<size_t>(i)]);
        const double t = std::exp(-opticalDepthOfSegment(m, h, mu, length)[i]);
        EXPECT_NEAR(t, expected, tolerance * std::max(expected, 0.001))
            << name << " " << view.h << " " << view.mu;
      }
    }
  }
}

TYPED_TEST(OpticalDepth, SegmentsFollowTheScaleHeightInAnyShell) {
  using Real = typename TypeParam::Real;
  struct Shell {
    double thickness, rayleigh, mie;
  };
  for (const Shell& shell : {Shell{60e3, 8e3, 100.0}, Shell{200e3, 8e3, 1200.0},
                             Shell{1000e3, 8e3, 1200.0}, Shell{500e3, 50e3, 50e3}}) {
    Parameters p = preset("earth-fig6");
    p.topRadius_m = p.bottomRadius_m + shell.thickness;
    p.rayleigh.scaleHeight_m = shell.rayleigh;
    p.mie.scaleHeight_m = shell.mie;
    const auto m = TypeParam::medium(p);
    const auto exactMedium = makeMediumF64(p);
    for (const View& view : {View{0, 1}, View{2, -0.5}, View{1000, 0.05}, View{30e3, -0.9}}) {
      const Real h = static_cast<Real>(view.h), mu = static_cast<Real>(view.mu);
      const Real length = lengthOf(m, h, mu);
      const auto exact = reference::opticalDepth(
          exactMedium,
          {static_cast<double>(h), static_cast<double>(mu), static_cast<double>(length)},
          {1e-12, 0.0});
      for (int i = 0; i < 3; ++i) {
        const double expected = exact.value[static_cast<size_t>(i)];
        EXPECT_NEAR(opticalDepthOfSegment(m, h, mu, length)[i], expected, 1e-3 * expected)
            << shell.thickness << " " << view.h << " " << view.mu;
      }
    }
  }
}

TYPED_TEST(OpticalDepth, OneRuleCoversGroundPixels) {
  using Real = typename TypeParam::Real;
  const Parameters p = preset("earth");
  const auto m = TypeParam::medium(p);
  const auto exactMedium = makeMediumF64(p);
  for (double h : {2.0, 1e3, 1e4, 6e4}) {
    const double horizon = horizonMu(exactMedium, h);
    for (double below : {1e-4, 1e-3, 1e-2, 0.1, 0.3, 1.0}) {
      const Real mu = static_cast<Real>(horizon - (1.0 + horizon) * below);
      const Real length = distanceToGround(m, static_cast<Real>(h), mu);
      const auto exact = reference::opticalDepth(
          exactMedium, {h, static_cast<double>(mu), static_cast<double>(length)}, {1e-12, 0.0});
      for (int i = 0; i < 3; ++i) {
        const double expected = std::exp(-exact.value[static_cast<size_t>(i)]);
        const double t =
            std::exp(-opticalDepthToGround(m, static_cast<Real>(h), mu, length, true)[i]);
        EXPECT_NEAR(t, expected, 1e-3 * std::max(expected, 0.01)) << h << " " << mu;
      }
    }
  }
}

TYPED_TEST(OpticalDepth, TrapezoidsTowardsTheTopAgreeWithTheReference) {
  // The standard solver's 500 trapezoids miss by (dx / H)^2 / 12 of the aerosols.
  using Real = typename TypeParam::Real;
  for (const char* name : {"earth", "earth-fig6", "mars"}) {
    const Parameters p = preset(name);
    const auto m = TypeParam::medium(p);
    const auto exactMedium = makeMediumF64(p);
    for (const View& view : kViews) {
      const Real h = static_cast<Real>(view.h), mu = static_cast<Real>(view.mu);
      const auto exact = reference::opticalDepthToTop(exactMedium, static_cast<double>(h),
                                                      static_cast<double>(mu), {1e-12, 0.0});
      for (int i = 0; i < 3; ++i) {
        const double expected = std::exp(-exact.value[static_cast<size_t>(i)]);
        const double t = std::exp(-opticalDepthToTop(m, h, mu, 500)[i]);
        EXPECT_NEAR(t, expected, 1e-3 * std::max(expected, 0.001))
            << name << " " << view.h << " " << view.mu;
      }
    }
  }
}

TYPED_TEST(OpticalDepth, GaussRuleIsExactForDegree23) {
  using Real = typename TypeParam::Real;
  const auto node = [](int i) {
    if constexpr (std::is_same_v<Real, float>) {
      return physics_f32::gaussLegendre12(i);
    } else {
      return physics_f64::gaussLegendre12(i);
    }
  };
  const double tolerance = std::is_same_v<Real, float> ? 1e-6 : 1e-15;
  for (int degree : {0, 1, 5, 12, 23}) {
    double sum = 0;
    for (int i = 0; i < 12; ++i) {
      sum += static_cast<double>(node(i)[1]) * std::pow(static_cast<double>(node(i)[0]), degree);
    }
    EXPECT_NEAR(sum, 1.0 / (degree + 1), tolerance) << degree;
  }
}

TYPED_TEST(OpticalDepth, DirectionsBelowTheHorizonAnswerForIt) {
  using Real = typename TypeParam::Real;
  const auto m = TypeParam::medium(preset("earth"));
  for (Real h : {Real(0), Real(2), Real(9000)}) {
    const Real edge = horizonMu(m, h);
    EXPECT_EQ(opticalDepthToTop(m, h, Real(-1), 500)[1], opticalDepthToTop(m, h, edge, 500)[1]);
  }
}

}  // namespace
}  // namespace alpenglow::test
