#include "atmosphere/shafts/caster_pass.h"

#include "engine/pipeline.h"

namespace alpenglow {
namespace shafts {

void drawCasters(const CasterPass& pass, VkPipeline pipeline, const VkRect2D& area,
                 const Casters& casters) {
  const engine::Dispatch& vk = pass.device->vk();
  engine::setArea(*pass.device, pass.commands, area);
  vk.CmdBindPipeline(pass.commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  const double centre[3] = {};
  placeCaster(&pass, centre, nullptr);
  casters.draw(casters.user, pass.commands, &pass);
  ++pass.device->counters().draws;
}

}  // namespace shafts

inline namespace v1 {

void placeCaster(const CasterPass* pass, const double origin_m[3], const float rotation[9]) {
  float rows[3][4];
  if (pass->map != nullptr)
    shafts::rowsOnMap(*pass->map, origin_m, rotation, rows);
  else
    shafts::rowsFromEye(pass->eye, origin_m, rotation, rows);
  pass->device->vk().CmdPushConstants(pass->commands, pass->layout, shafts::kPlaceRange.stageFlags,
                                      0, sizeof rows, rows);
}

}  // namespace v1
}  // namespace alpenglow
