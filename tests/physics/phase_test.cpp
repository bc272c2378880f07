#include <numbers>

#include "atmosphere/reference/quadrature.h"
#include "physics_overloads.h"

namespace alpenglow::test {
namespace {

template <class P>
class Phase : public testing::Test {};
TYPED_TEST_SUITE(Phase, Precisions, PrecisionNames);

constexpr double kAsymmetries[] = {-0.99, -0.9, -0.5, -0.1, 0.0, 0.1, 0.5, 0.76, 0.9, 0.97, 0.99};

/// Integrals over the sphere of a phase function, and of it times nu.
template <class Function>
std::array<double, 2> moments(const Function& phase) {
  const auto integrand = [&](double nu) {
    const double value = 2 * std::numbers::pi * static_cast<double>(phase(nu));
    return std::array<double, 2>{value, nu * value};
  };
  // A forward peak of (1 - g)^-2 in the last thousandths.
  const std::vector<double> breaks = {-1, -0.999, -0.99, -0.9, 0, 0.9, 0.99, 0.999, 1};
  const auto result = reference::integrate<2>(integrand, breaks, {0.0, 1e-8});
  return result.value;
}

TYPED_TEST(Phase, FunctionsIntegrateToOne) {
  using Real = typename TypeParam::Real;
  // Float: the rounding of single values, not of the quadrature.
  const double tolerance = std::is_same_v<Real, float> ? 1e-5 : 1e-8;
  const auto rayleigh = [](double nu) { return rayleighPhase(static_cast<Real>(nu)); };
  EXPECT_NEAR(moments(rayleigh)[0], 1.0, tolerance);
  EXPECT_NEAR(moments(rayleigh)[1], 0.0, tolerance);
  for (double g : kAsymmetries) {
    const auto mie = [g](double nu) {
      return miePhase(static_cast<Real>(g), static_cast<Real>(nu));
    };
    const auto [sum, cosine] = moments(mie);
    EXPECT_NEAR(sum, 1.0, tolerance) << g;
    EXPECT_NEAR(cosine, 3 * g * (4 + g * g) / (5 * (2 + g * g)), tolerance) << g;
  }
}

TYPED_TEST(Phase, WithoutAsymmetryMieIsRayleigh) {
  using Real = typename TypeParam::Real;
  for (Real nu : {Real(-1), Real(-0.3), Real(0), Real(0.7), Real(1)}) {
    EXPECT_NEAR(miePhase(Real(0), nu), rayleighPhase(nu), 1e-7) << nu;
  }
}

TYPED_TEST(Phase, MirrorsWithTheSignOfTheAsymmetry) {
  using Real = typename TypeParam::Real;
  for (double g : kAsymmetries) {
    for (Real nu : {Real(-1), Real(-0.3), Real(0.99), Real(1)}) {
      EXPECT_EQ(miePhase(static_cast<Real>(g), nu), miePhase(static_cast<Real>(-g), -nu)) << g;
    }
  }
}

TEST(PhaseInFloat, KeepsItsDigitsInTheForwardPeak) {
  // 1 + g^2 - 2 g nu would lose three of them: (1 - 0.99)^2 = 1e-4 from terms near 2.
  for (float g : {0.9f, 0.99f, 0.999f}) {
    for (float nu : {1.0f, std::nextafter(1.0f, 0.0f), 0.9999f, 0.99f}) {
      const double exact = miePhase(static_cast<double>(g), static_cast<double>(nu));
      EXPECT_NEAR(miePhase(g, nu), exact, 4e-6 * exact) << g << " " << nu;
    }
  }
}

TYPED_TEST(Phase, RoundingBeyondOneIsHarmless) {
  using Real = typename TypeParam::Real;
  const Real above = std::nextafter(Real(1), Real(2));
  for (Real g : {Real(0.99), Real(-0.99)}) {
    EXPECT_TRUE(std::isfinite(miePhase(g, above)) && miePhase(g, above) > 0);
    EXPECT_TRUE(std::isfinite(miePhase(g, -above)) && miePhase(g, -above) > 0);
  }
}

}  // namespace
}  // namespace alpenglow::test
