// Points along a ray that follow its densities, for rough integrals and for sampling distances.
#pragma once

#include <array>

#include "atmosphere/reference/optical_depth.h"

namespace alpenglow::reference {

struct RayNode {
  double t = 0.0;
  double h = 0.0;
  double muS = 1.0;
  double rayleigh = 0.0;  ///< Relative densities.
  double mie = 0.0;
  physics_f64::Spectrum transmittance;  ///< From the ray's start, by trapezoids: rough.
};

/// Nodes lie in geometric steps from where the atmosphere is densest or the ray begins, the first
/// as long as the nearest scale there: a part of a scale height or of a mean free path.
class RayNodes {
 public:
  /// Intervals of each side of a point where steps are smallest.
  static constexpr int kFine = 12;
  static constexpr int kCoarse = 7;

  /// The segment lies in the atmosphere; `muS` and `nu` are those at its start.
  RayNodes(const Medium& medium, const RaySegment& segment, double muS, double nu, int intervals);
  int count() const { return count_; }
  const RayNode& operator[](int i) const { return nodes_[static_cast<size_t>(i)]; }

 private:
  void place(double from, double to, double scale, int intervals);
  void fill(const Medium& medium, const RaySegment& segment, double muS, double nu);

  std::array<RayNode, 3 * kFine + 2> nodes_;
  int count_ = 0;
};

}  // namespace alpenglow::reference
