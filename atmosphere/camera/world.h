// Conversion from a host's world to the planet frame.
#pragma once

#include "atmosphere/camera/picture.h"

namespace alpenglow::passes {

/// A World with its zeros replaced.
struct Placement {
  explicit Placement(const World& world);

  void toPlanet(const double position[3], double out_m[3]) const;
  void directionToPlanet(const double direction[3], double out[3]) const;
  void toWorld(const double position_m[3], double out[3]) const;
  void directionToWorld(const double direction[3], double out[3]) const;
  /// Rows of a rotation (null: none) of the world, as rows of the planet frame.
  void rotateRows(const float rotation[9], float out[9]) const;

  double origin[3];
  double axes[3][3];  ///< World x, y, z in the planet frame.
};

/// Needs a checked world. Zero axes of the box stand for the world's.
PlanetBox planetBox(const Placement& placement, const Box& box);

}  // namespace alpenglow::passes
