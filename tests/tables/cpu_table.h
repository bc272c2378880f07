// A table of the device in double, which the physics text reads on the CPU.
#pragma once

#include "atmosphere/parameters/physics_cpp.h"
#include "tests/tables/bake_fixture.h"

namespace alpenglow::testing {

/// Four values a texel, x fastest.
struct DoubleTable {
  uint32_t width = 0, height = 0, depth = 0;
  std::vector<double> values;

  DoubleTable() = default;
  explicit DoubleTable(const CpuTable& table)
      : width(table.info.extent.width),
        height(table.info.extent.height),
        depth(table.info.extent.depth),
        values(table.values.begin(), table.values.end()) {}
  DoubleTable(uint32_t w, uint32_t h, uint32_t d)
      : width(w), height(h), depth(d), values(size_t(4) * w * h * d) {}

  double* at(uint32_t x, uint32_t y, uint32_t z) {
    return &values[4 * ((size_t(z) * height + y) * width + x)];
  }
  /// Linear filtering with clamped edges, as the sampler does it.
  glm::dvec4 sample(double u, double v, double w) const;
};

inline glm::dvec4 DoubleTable::sample(double u, double v, double w) const {
  const auto axis = [](double coordinate, uint32_t size, uint32_t* lower, uint32_t* upper) {
    const double x = glm::clamp(coordinate * size - 0.5, 0.0, size - 1.0);
    *lower = static_cast<uint32_t>(x);
    *upper = std::min(*lower + 1, size - 1);
    return x - *lower;
  };
  uint32_t x[2], y[2], z[2];
  const double fx = axis(u, width, &x[0], &x[1]);
  const double fy = axis(v, height, &y[0], &y[1]);
  const double fz = axis(w, depth, &z[0], &z[1]);
  glm::dvec4 sum(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = (corner >> 1) & 1, k = corner >> 2;
    const double weight = (i ? fx : 1.0 - fx) * (j ? fy : 1.0 - fy) * (k ? fz : 1.0 - fz);
    const double* t = &values[4 * ((size_t(z[k]) * height + y[j]) * width + x[i])];
    sum += weight * glm::dvec4(t[0], t[1], t[2], t[3]);
  }
  return sum;
}

}  // namespace alpenglow::testing
