// The harmonics of the moment solver by their definitions: orthonormal, the phase function's
// coefficients as integrals, and the turn from the zenith's frame to the sun's against quadrature.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "atmosphere/reference/quadrature.h"
#include "tests/tables/harmonics_cpp.h"

namespace alpenglow::testing {
namespace {

constexpr double kPi = std::numbers::pi;

/// Y_lm of a direction given by its cosine and azimuth.
double harmonic(int l, int m, double mu, double phi) {
  const double factor = m == 0 ? 1.0 : std::sqrt(2.0) * std::cos(m * phi);
  return harmonics_f64::legendre(l, m, mu) * factor;
}

/// The integral over the sphere of a function of (mu, phi) that is a polynomial of the direction.
template <class Function>
double overSphere(Function&& function) {
  constexpr int kAzimuths = 64;
  const auto ring = [&](double mu) {
    double sum = 0.0;
    for (int i = 0; i < kAzimuths; ++i) sum += function(mu, 2.0 * kPi * (i + 0.5) / kAzimuths);
    return std::array<double, 1>{sum * 2.0 * kPi / kAzimuths};
  };
  return reference::integrate<1>(ring, {-1.0, 0.0, 1.0}, {1e-12, 1e-10}).value[0];
}

TEST(Harmonics, AreOrthonormal) {
  for (int l = 0; l <= 6; ++l)
    for (int k = 0; k <= 6; ++k)
      for (int m = 0; m <= std::min(l, k); ++m) {
        const double product = overSphere([&](double mu, double phi) {
          return harmonic(l, m, mu, phi) * harmonic(k, m, mu, phi);
        });
        EXPECT_NEAR(product, l == k ? 1.0 : 0.0, 1e-9) << l << " " << k << " " << m;
      }
}

TEST(Harmonics, AnIndexIsOfItsDegree) {
  for (int l = 0; l <= 60; ++l)
    for (int m : {0, l / 2, l}) {
      EXPECT_EQ(harmonics_f32::degreeOf(l * (l + 1) / 2 + m), l) << m;
      EXPECT_EQ(harmonics_f64::degreeOf(l * (l + 1) / 2 + m), l) << m;
    }
}

TEST(Harmonics, CoefficientsOfAerosolsAreIntegralsOfTheirPhaseFunction) {
  for (double g : {-0.6, 0.0, 0.3, 0.76, 0.93})
    for (int l : {0, 1, 2, 3, 7, 20, 47}) {
      const auto integrand = [&](double nu) {
        return std::array<double, 1>{2.0 * kPi * physics_f64::miePhase(g, nu) *
                                     std::legendre(static_cast<unsigned>(l), nu)};
      };
      const std::vector<double> breaks = {-1.0, -0.9, 0.0, 0.5, 0.9, 0.99, 1.0};
      const double exact = reference::integrate<1>(integrand, breaks, {1e-10, 1e-9}).value[0];
      EXPECT_NEAR(harmonics_f64::mieCoefficient(g, l), exact, 1e-8) << g << " " << l;
    }
}

// (l, from) about the zenith and (l, to) about the sun, at one and the same direction.
double rotationByQuadrature(int l, int to, int from, double beta) {
  return overSphere([&](double mu, double phi) {
    const double sine = std::sqrt(1.0 - mu * mu);
    const double x = sine * std::cos(phi), y = sine * std::sin(phi);
    const double z = x * std::sin(beta) + mu * std::cos(beta);
    const double down = x * std::cos(beta) - mu * std::sin(beta);
    return harmonic(l, from, mu, phi) * harmonic(l, to, z, std::atan2(y, down));
  });
}

TEST(Harmonics, TurnTowardsTheSun) {
  for (double beta : {0.0, 0.4, 1.6, 2.9})
    for (int l = 0; l <= 4; ++l)
      for (int to = 0; to <= l; ++to)
        for (int from = 0; from <= l; ++from)
          EXPECT_NEAR(harmonics_f64::rotation(l, to, from, std::cos(beta)),
                      rotationByQuadrature(l, to, from, beta), 1e-8)
              << l << " " << to << " " << from << " at " << beta;
}

// Rows of a rotation are orthonormal, also for the highest degree in float.
TEST(Harmonics, TurnsKeepLength) {
  constexpr int kDegree = 47;
  for (float beta : {0.0f, 0.03f, 1.0f, 1.57f, 2.2f, 3.1f}) {
    const float cosine = std::cos(beta);
    for (int to = 0; to <= kDegree; ++to) {
      double length = 0.0, product = 0.0;
      for (int from = 0; from <= kDegree; ++from) {
        const double value = harmonics_f32::rotation(kDegree, to, from, cosine);
        length += value * value;
        product += value * static_cast<double>(harmonics_f32::rotation(
                               kDegree, (to + 1) % (kDegree + 1), from, cosine));
      }
      EXPECT_NEAR(length, 1.0, 1e-4) << to << " at " << beta;
      EXPECT_NEAR(product, 0.0, 1e-4) << to << " at " << beta;
    }
  }
}

}  // namespace
}  // namespace alpenglow::testing
