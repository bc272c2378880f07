#include <gtest/gtest.h>

#include <cmath>

#include "atmosphere/reference/quadrature.h"

namespace alpenglow::reference {
namespace {

TEST(Quadrature, IsExactForPolynomialsOfDegree22) {
  for (int degree = 0; degree <= 22; ++degree) {
    const auto power = [degree](double x) { return std::array<double, 1>{std::pow(x, degree)}; };
    const auto rule = detail::applyRule<1>(power, 0.0, 1.0);
    EXPECT_NEAR(rule.integral.value[0], 1.0 / (degree + 1), 1e-15) << degree;
  }
}

TEST(Quadrature, KronrodRuleIsNotExactForDegree24) {
  const auto power = [](double x) { return std::array<double, 1>{std::pow(x, 24)}; };
  EXPECT_GT(std::abs(detail::applyRule<1>(power, -1.0, 1.0).integral.value[0] - 2.0 / 25), 1e-12);
}

TEST(Quadrature, SeveralFunctionsAtOnceMeetTheTolerance) {
  // A kink, an end singularity and a peak of width 1e-4, each with its integral.
  const auto functions = [](double x) {
    return std::array<double, 3>{std::abs(x - 0.3), std::sqrt(x),
                                 1e-4 / ((x - 0.7) * (x - 0.7) + 1e-8)};
  };
  const double expected[] = {0.5 * (0.09 + 0.49), 2.0 / 3.0, std::atan(0.3e4) + std::atan(0.7e4)};
  for (double tolerance : {1e-4, 1e-8, 1e-11}) {
    const auto result = integrate<3>(functions, {0.0, 1.0}, {tolerance, 0.0});
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_LE(std::abs(result.value[i] - expected[i]), tolerance * expected[i]) << i;
      EXPECT_LE(std::abs(result.value[i] - expected[i]), result.error[i] + 1e-15) << i;
      EXPECT_LE(result.error[i], tolerance * expected[i]) << i;
    }
  }
}

TEST(Quadrature, SaysSoWhenItGivesUp) {
  const auto noise = [](double x) { return std::array<double, 1>{std::sin(1e9 * x) + 1.0}; };
  const auto result = integrate<1>(noise, {0.0, 1.0}, {1e-12, 0.0}, 20);
  EXPECT_GT(result.error[0], 1e-3);
}

TEST(Quadrature, EmptyRangeIsZero) {
  const auto one = [](double) { return std::array<double, 1>{1.0}; };
  EXPECT_EQ(integrate<1>(one, {2.0, 2.0}, {1e-9, 0.0}).value[0], 0.0);
  EXPECT_EQ(integrate<1>(one, {}, {1e-9, 0.0}).value[0], 0.0);
}

}  // namespace
}  // namespace alpenglow::reference
