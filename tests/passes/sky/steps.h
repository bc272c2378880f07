// Promise of the design: a step between neighbours is at most three times what is due there plus
// 0.1 %. Along a row of values that should be smooth, what is due are the next steps on both sides.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace alpenglow::testing {

/// Relative to the value, or to a darkness below which nothing is seen.
struct Steps {
  double largest = 0.0;  ///< Between neighbours.
  double jump = 0.0;     ///< By how much one exceeds three times the next steps.

  void add(const Steps& other) {
    largest = std::max(largest, other.largest);
    jump = std::max(jump, other.jump);
  }
};

/// Of at(0) ... at(count - 1).
template <class At>
Steps stepsOf(size_t count, double dark, At at) {
  Steps result;
  for (size_t i = 2; i + 1 < count; ++i) {
    const double scale = std::max<double>(at(i), dark);
    const double step = std::abs(at(i) - at(i - 1));
    const double next =
        std::max<double>(std::abs(at(i - 1) - at(i - 2)), std::abs(at(i + 1) - at(i)));
    if (!std::isfinite(step)) return {1e30, 1e30};
    result.largest = std::max(result.largest, step / scale);
    result.jump = std::max(result.jump, (step - 3.0 * next) / scale);
  }
  return result;
}

}  // namespace alpenglow::testing
