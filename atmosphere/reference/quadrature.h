// Adaptive Gauss-Kronrod quadrature (7 and 15 points) of several functions at once, which share
// their costly part. The intervals with the largest error are halved until every function's total
// error is below its tolerance.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace alpenglow::reference {

/// Integrals of N functions, with bounds on their errors as the rule estimates them.
template <size_t N>
struct Integral {
  std::array<double, N> value{};
  std::array<double, N> error{};
};

/// Done when error <= relative |value| + absolute for each function.
struct Tolerance {
  double relative = 1e-9;
  double absolute = 0.0;
};

namespace detail {

template <size_t N>
struct Interval {
  double low = 0.0;
  double high = 0.0;
  Integral<N> integral;
};

/// Nodes of the 15-point Kronrod rule on [-1, 1] with their weights, outermost first; the odd ones
/// are the nodes of the 7-point Gauss rule.
inline constexpr double kNodes[8] = {
    0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
    0.586087235467691130294144838258730, 0.405845151377397166906606412076961,
    0.207784955007898467600689403773245, 0.0};
inline constexpr double kKronrodWeights[8] = {
    0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
    0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
    0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
    0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
inline constexpr double kGaussWeights[4] = {
    0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
    0.381830050505118944950369775488975, 0.417959183673469387755102040816327};

/// The error of a Kronrod value, from its distance to the Gauss value and the integrand's variation
/// about its mean, as QUADPACK estimates it (Piessens et al. 1983).
inline double estimateError(double difference, double variation, double magnitude) {
  double error = std::abs(difference);
  if (variation > 0.0 && error > 0.0) {
    error = variation * std::min(1.0, std::pow(200.0 * error / variation, 1.5));
  }
  return std::max(error, 50.0 * std::numeric_limits<double>::epsilon() * magnitude);
}

template <size_t N, class Function>
Interval<N> applyRule(const Function& function, double low, double high) {
  const double center = 0.5 * (low + high);
  const double half = 0.5 * (high - low);
  std::array<std::array<double, N>, 15> samples;
  for (size_t i = 0; i < 8; ++i) {
    samples[i] = function(center - half * kNodes[i]);
    if (i < 7) {
      samples[14 - i] = function(center + half * kNodes[i]);
    }
  }
  Interval<N> result{low, high, {}};
  for (size_t c = 0; c < N; ++c) {
    double kronrod = 0.0, gauss = 0.0, magnitude = 0.0;
    for (size_t i = 0; i < 15; ++i) {
      const size_t k = std::min(i, 14 - i);
      kronrod += kKronrodWeights[k] * samples[i][c];
      magnitude += kKronrodWeights[k] * std::abs(samples[i][c]);
      if (k % 2 == 1) {
        gauss += kGaussWeights[k / 2] * samples[i][c];
      }
    }
    double variation = 0.0;
    for (size_t i = 0; i < 15; ++i) {
      variation += kKronrodWeights[std::min(i, 14 - i)] * std::abs(samples[i][c] - 0.5 * kronrod);
    }
    result.integral.value[c] = kronrod * half;
    result.integral.error[c] =
        estimateError((kronrod - gauss) * half, variation * half, magnitude * half);
  }
  return result;
}

}  // namespace detail

/// Integrates function(t) -> std::array<double, N> from breaks.front() to breaks.back(). `breaks`
/// rise; they stand where the function or a derivative steps and where its scale changes. Gives up
/// halving after `maxIntervals`; the errors then say so.
template <size_t N, class Function>
Integral<N> integrate(const Function& function, const std::vector<double>& breaks,
                      const Tolerance& tolerance, size_t maxIntervals = 2000) {
  std::vector<detail::Interval<N>> intervals;
  intervals.reserve(breaks.size() + 16);
  for (size_t i = 0; i + 1 < breaks.size(); ++i) {
    if (breaks[i + 1] > breaks[i]) {
      intervals.push_back(detail::applyRule<N>(function, breaks[i], breaks[i + 1]));
    }
  }
  for (;;) {
    Integral<N> total;
    for (const auto& interval : intervals) {
      for (size_t c = 0; c < N; ++c) {
        total.value[c] += interval.integral.value[c];
        total.error[c] += interval.integral.error[c];
      }
    }
    std::array<double, N> allowed;
    bool done = true;
    for (size_t c = 0; c < N; ++c) {
      allowed[c] = tolerance.relative * std::abs(total.value[c]) + tolerance.absolute;
      done = done && total.error[c] <= allowed[c];
    }
    if (done || intervals.size() >= maxIntervals) {
      return total;
    }
    // Worst first: the share of the allowed error that an interval uses up.
    size_t worst = 0;
    double worstShare = -1.0;
    for (size_t i = 0; i < intervals.size(); ++i) {
      double share = 0.0;
      for (size_t c = 0; c < N; ++c) {
        if (total.error[c] > allowed[c]) {
          share = std::max(share, intervals[i].integral.error[c] /
                                      std::max(allowed[c], std::numeric_limits<double>::min()));
        }
      }
      if (share > worstShare) {
        worst = i;
        worstShare = share;
      }
    }
    const double low = intervals[worst].low, high = intervals[worst].high;
    const double middle = 0.5 * (low + high);
    if (!(middle > low && middle < high)) {
      return total;  // An interval of neighbouring numbers: rounding is all that is left.
    }
    intervals[worst] = detail::applyRule<N>(function, low, middle);
    intervals.push_back(detail::applyRule<N>(function, middle, high));
  }
}

}  // namespace alpenglow::reference
