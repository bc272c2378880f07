#include "atmosphere/passes/caster_pass.h"

#include "atmosphere/camera/world.h"
#include "engine/pipeline.h"

namespace alpenglow {
namespace passes {

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
  const double origin[3] = {};
  placeCaster(pass, commands, origin, nullptr);
  if (casters.draw != nullptr) casters.draw(casters.user, commands, pass);
  ++device.counters().draws;
}

}  // namespace passes

inline namespace v1 {

void placeCaster(const CasterPass& pass, VkCommandBuffer commands, const double origin[3],
                 const float rotation[9]) {
  const auto* target = static_cast<const passes::CasterTarget*>(pass.internal);
  if (target == nullptr || commands == VK_NULL_HANDLE || origin == nullptr) return;
  const passes::Placement placement(*target->world);
  double origin_m[3];
  placement.toPlanet(origin, origin_m);
  float turned[9];
  placement.rotateRows(rotation, turned);
  float rows[3][4];
  if (target->map != nullptr)
    passes::rowsOnMap(*target->map, origin_m, turned, rows);
  else
    passes::rowsFromEye(target->eye, origin_m, turned, rows);
  target->device->vk().CmdPushConstants(commands, target->layout, passes::kPlaceRange.stageFlags, 0,
                                        sizeof rows, rows);
}

}  // namespace v1
}  // namespace alpenglow
