// Columns of the densities along rays in closed form or from a table made once: what the path
// tracer uses where single scattering integrates. Within 1e-6 of the adaptive integral, as a test
// has it.
#pragma once

#include <vector>

#include "atmosphere/parameters/physics_cpp.h"

namespace alpenglow::reference {

using physics_f64::Medium;

/// Densities integrated over a length, in metres.
struct Column {
  double rayleigh = 0.0;
  double mie = 0.0;
  double absorption = 0.0;
};
inline Column operator+(const Column& a, const Column& b) {
  return {a.rayleigh + b.rayleigh, a.mie + b.mie, a.absorption + b.absorption};
}
inline Column operator-(const Column& a, const Column& b) {
  return {a.rayleigh - b.rayleigh, a.mie - b.mie, a.absorption - b.absorption};
}

/// The integral of exp(-altitude / scale height) from a point upwards to infinity: the Chapman
/// function, tabulated over ln r and asinh(mu sqrt(r / scale height)), where it is smooth, and
/// interpolated by cubics.
class ChapmanTable {
 public:
  ChapmanTable() = default;
  ChapmanTable(double bottomRadius, double thickness, double scaleHeight);
  /// In metres, for 0 <= h <= thickness, 0 <= mu <= 1.
  double column(double h, double mu) const;

 private:
  static constexpr int kRadii = 32;
  static constexpr int kCosines = 256;

  double bottomRadius_ = 1.0;
  double scaleHeight_ = 1.0;
  double radiusScale_ = 0.0;    ///< Nodes per unit of ln(r / Rg).
  std::vector<double> values_;  ///< Scale height over column, radius by radius.
};

class Columns {
 public:
  explicit Columns(const Medium& medium);

  /// From a point upwards, without a top (except for the absorption's): only differences of two on
  /// one ray have a meaning. mu >= 0.
  Column upwards(double h, double mu) const;

  /// From a point inside the atmosphere to the top; a direction below the horizon answers for the
  /// horizon, as opticalDepthToTop() has it.
  Column toTop(double h, double mu) const;

  /// Between two points of a ray, `from` before `to`, both above the ground. `start` is
  /// upwards(h, |mu|) of the first.
  Column between(double h0, double mu0, const Column& start, double h1, double mu1) const;

  /// Optical depth of a column.
  physics_f64::Spectrum depth(const Column& column) const;

 private:
  double absorptionUpwards(double h, double mu) const;

  const Medium& medium_;
  bool hasRayleigh_, hasMie_, hasAbsorption_;
  ChapmanTable rayleigh_, mie_;
};

}  // namespace alpenglow::reference
