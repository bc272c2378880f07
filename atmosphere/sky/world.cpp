#include "atmosphere/sky/world.h"

#include <algorithm>
#include <cmath>

#include "atmosphere/sky/camera_math.h"

namespace alpenglow::sky {
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
        const double turned = rotation != nullptr ? rotation[3 * i + column] : i == column ? 1.0 : 0.0;
        sum += axes[i][row] * turned;
      }
      out[3 * row + column] = static_cast<float>(sum);
    }
  }
}

Status checkWorld(const engine::Device& device, const World& world) {
  for (const double value : world.origin_m) {
    if (std::abs(value) < 1e15) continue;  // False for NaN too.
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "World::origin_m has a value of %g, but each must be finite and within 1e15 m "
                       "of the planet's centre.",
                       value);
  }
  const Placement placement(world);
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const double product = dot(placement.axes[i], placement.axes[j]);
      if (std::abs(product - (i == j ? 1.0 : 0.0)) < 1e-4) continue;
      return device.fail(Status::InvalidArgument, VK_SUCCESS,
                         "World::axes has axes %d and %d with the scalar product %g, but needs "
                         "orthonormal ones, or all 0 for the planet frame.",
                         i, j, product);
    }
  }
  if (world.metersPerUnit != 0.0 && world.metersPerUnit != 1.0) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "World::metersPerUnit is %g, but must be 0 or 1 in this version.",
                       world.metersPerUnit);
  }
  if (world.equatorialRadius_m != 0.0 || world.polarRadius_m != 0.0) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "World::equatorialRadius_m is %g and polarRadius_m %g, but both must be 0 in "
                       "this version: altitudes are above the sphere.",
                       world.equatorialRadius_m, world.polarRadius_m);
  }
  return Status::Ok;
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

}  // namespace alpenglow::sky
