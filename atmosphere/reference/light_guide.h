// A rough solution of the whole light field, on a small grid of (altitude, sun zenith angle). It
// only guides the path tracer's sampling: wrong values cost time, not accuracy.
#pragma once

#include <cstdint>
#include <vector>

#include "atmosphere/reference/columns.h"

namespace alpenglow::reference {

/// Light at a point, per unit solar irradiance.
struct GuideLight {
  physics_f64::Spectrum mean;      ///< Mean radiance over all directions, the sun left out.
  physics_f64::Spectrum sunlight;  ///< Transmittance to the sun times its visible part.
};

/// From where the light comes to a point: the probability of each cell of a grid of directions,
/// whose rows are squeezed towards the point's horizon, above and below, and whose columns are
/// azimuths from the sun's, on either side.
class DirectionGrid {
 public:
  static constexpr int kSkyRows = 10;
  static constexpr int kGroundRows = 4;
  static constexpr int kColumns = 8;
  static constexpr int kCells = (kSkyRows + kGroundRows) * kColumns;

  DirectionGrid(const float* sums, double horizon) : sums_(sums), horizon_(horizon) {}

  /// Zenith cosine and azimuth from the sun's of a direction drawn with uniform numbers.
  struct Angles {
    double mu, phi;
  };
  Angles sample(double u, double v, double w) const;
  /// Per steradian.
  double density(double mu, double cosPhi) const;
  /// Ends of a row in mu, the nearer to the horizon first.
  static Angles rowEnds(int row, double horizon);

 private:
  const float* sums_;  ///< Running sums of the cells' probabilities; the last is 1.
  double horizon_;
};

class LightGuide {
 public:
  LightGuide(const Medium& medium, const Columns& columns);
  GuideLight at(double h, double muS) const;
  DirectionGrid directionsAt(double h, double muS) const;

 private:
  static constexpr int kAltitudes = 18;
  static constexpr int kSuns = 60;
  static constexpr int kValues = 6;
  static constexpr int kLookup = 4096;

  struct Node {
    float values[kValues] = {};
  };

  double altitudePosition(double h) const;
  float sunPosition(double muS) const;
  double altitudeOf(int i) const;
  static double sunAngleOf(int j);
  void iterate();
  Node gather(double h, double sunAngle, float* cells) const;
  physics_f64::Spectrum radiance(double h, double mu, double muS, double nu) const;

  const Medium& medium_;
  std::vector<Node> nodes_;
  std::vector<float> cells_;        ///< DirectionGrid's sums of each node.
  std::vector<float> sunPosition_;  ///< Grid coordinate over mu_s, which is costly to compute.
};

}  // namespace alpenglow::reference
