// Where along a ray the sunlight changes abruptly.
#pragma once

#include <vector>

#include "atmosphere/reference/optical_depth.h"

namespace alpenglow::reference {

/// A ray inside the atmosphere, seen by the sun. Cosines are those at its start.
struct SunlitRay {
  RaySegment segment;
  double muS = 1.0;
  double nu = 1.0;
  /// |v x s|^2 and r (mu - mu_s nu) at the start, from vectors: as differences of cosines they
  /// would cancel for rays towards the sun or away from it.
  double sineSquared = 0.0;
  double across = 0.0;
};

/// Adds the distances at which the ray passes the edge of the planet's shadow, those where the
/// light passes the bends of the absorption tent at its lowest point, and, for a sun with a disc,
/// those where the disc touches the horizon. Unsorted.
void addSunlightBreaks(const Medium& medium, const SunlitRay& ray, std::vector<double>& breaks);

}  // namespace alpenglow::reference
