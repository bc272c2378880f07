#include "atmosphere/passes/caster_pass.h"

#include <cmath>

#include "atmosphere/camera/camera_math.h"
#include "atmosphere/camera/world.h"
#include "engine/pipeline.h"

namespace alpenglow {
namespace passes {
namespace {

void place(const CasterTarget& target, VkCommandBuffer commands, const double origin_m[3],
           const float turned[9]) {
  float rows[3][4];
  if (target.map != nullptr)
    rowsOnMap(*target.map, origin_m, turned, rows);
  else
    rowsFromEye(target.eye, origin_m, turned, rows);
  target.device->vk().CmdPushConstants(commands, target.layout, kPlaceRange.stageFlags, 0,
                                       sizeof rows, rows);
}

// Only a caster's origin is known here; its vertices may lie beside it, as those of a terrain about
// the terrain's origin. An origin very far from the bounds is in another frame or another unit.
void warnOutside(const CasterTarget& target, const double origin_m[3]) {
  const CasterSet& casters = *target.casters;
  if (casters.outsideReported == nullptr || *casters.outsideReported) return;
  double square = 0.0, radiusSquare = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double offset = origin_m[i] - casters.bounds.center_m[i];
    square += offset * offset;
    const double* half = casters.bounds.halfAxes_m[i];
    radiusSquare += dot(half, half);
  }
  constexpr double kFar = 30.0;  // Radii of the bounds.
  if (square <= kFar * kFar * radiusSquare) return;
  *casters.outsideReported = true;
  target.device->notice(
      Severity::Warning,
      "placeCaster got an origin %g m from the centre of Casters::bounds, whose "
      "corners are %g m from it: casters outside their bounds cast no shadow, and "
      "both are in world units and axes.",
      std::sqrt(square), std::sqrt(radiusSquare));
}

}  // namespace

void drawCasters(VkCommandBuffer commands, const CasterTarget& target, LightShaftMethod method,
                 const double origin_m[3], const double clipFromOrigin[16], VkPipeline pipeline,
                 const VkRect2D& area, const CasterSet& casters) {
  engine::Device& device = *target.device;
  const passes::Placement placement(casters.world);
  CasterPass pass;
  pass.method = method;
  pass.extent = area.extent;
  placement.toWorld(origin_m, pass.origin);
  // Columns of the world's axes, then the origin's.
  for (int row = 0; row < 4; ++row) {
    for (int axis = 0; axis < 3; ++axis) {
      double sum = 0.0;
      for (int i = 0; i < 3; ++i) sum += clipFromOrigin[4 * i + row] * placement.axes[axis][i];
      pass.clipFromOrigin[4 * axis + row] = static_cast<float>(sum);
    }
    pass.clipFromOrigin[12 + row] = static_cast<float>(clipFromOrigin[12 + row]);
  }
  pass.internal = &target;
  engine::setArea(device, commands, area);
  device.vk().CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  float axes[9];
  placement.rotateRows(nullptr, axes);
  place(target, commands, placement.origin, axes);
  if (casters.draw != nullptr) casters.draw(casters.user, commands, pass);
  ++device.counters().draws;
}

}  // namespace passes

inline namespace v1_0 {

void placeCaster(const CasterPass& pass, VkCommandBuffer commands, const double origin[3],
                 const float rotation[9]) {
  const auto* target = static_cast<const passes::CasterTarget*>(pass.internal);
  if (target == nullptr || commands == VK_NULL_HANDLE || origin == nullptr) return;
  const passes::Placement placement(target->casters->world);
  double origin_m[3];
  placement.toPlanet(origin, origin_m);
  float turned[9];
  placement.rotateRows(rotation, turned);
  passes::place(*target, commands, origin_m, turned);
  passes::warnOutside(*target, origin_m);
}

}  // namespace v1_0
}  // namespace alpenglow
