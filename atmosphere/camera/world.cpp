#include "atmosphere/camera/world.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/camera/camera_math.h"

namespace alpenglow::passes {
namespace {

bool isZero(const double axes[3][3]) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (axes[i][j] != 0.0) return false;
  return true;
}

}  // namespace

Placement::Placement(const World& world) {
  std::copy_n(world.origin_m, 3, origin);
  const bool planet = isZero(world.axes);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) axes[i][j] = planet ? (i == j ? 1.0 : 0.0) : world.axes[i][j];
}

void Placement::directionToPlanet(const double direction[3], double out[3]) const {
  double sum[3] = {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) sum[j] += direction[i] * axes[i][j];
  std::copy_n(sum, 3, out);
}

void Placement::toPlanet(const double position[3], double out_m[3]) const {
  directionToPlanet(position, out_m);
  for (int i = 0; i < 3; ++i) out_m[i] += origin[i];
}

void Placement::directionToWorld(const double direction[3], double out[3]) const {
  double sum[3];
  for (int i = 0; i < 3; ++i) sum[i] = dot(direction, axes[i]);
  std::copy_n(sum, 3, out);
}

void Placement::toWorld(const double position_m[3], double out[3]) const {
  const double from[3] = {position_m[0] - origin[0], position_m[1] - origin[1],
                          position_m[2] - origin[2]};
  directionToWorld(from, out);
}

void Placement::rotateRows(const float rotation[9], float out[9]) const {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      double sum = 0.0;
      for (int i = 0; i < 3; ++i) {
        const double turned = rotation != nullptr ? rotation[3 * i + column]
                              : i == column       ? 1.0
                                                  : 0.0;
        sum += axes[i][row] * turned;
      }
      out[3 * row + column] = static_cast<float>(sum);
    }
  }
}

PlanetBox planetBox(const Placement& placement, const Box& box) {
  PlanetBox out;
  placement.toPlanet(box.center, out.center_m);
  const bool plain = isZero(box.axes);
  for (int i = 0; i < 3; ++i) {
    const double unit[3] = {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
    placement.directionToPlanet(plain ? unit : box.axes[i], out.halfAxes_m[i]);
    for (double& value : out.halfAxes_m[i]) value *= box.halfExtents[i];
  }
  return out;
}

}  // namespace alpenglow::passes
