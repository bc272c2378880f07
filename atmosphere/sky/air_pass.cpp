// Aerial perspective of a view: the part of View that draws over a host's scene.
#include <alpenglow/shaders/sky_vertex.h>

#include <algorithm>

#include "atmosphere/bake/effect_constants.h"
#include "atmosphere/sky/air_set.h"
#include "atmosphere/sky/shader_choice.h"
#include "atmosphere/sky/sky_pass.h"

namespace alpenglow {
inline namespace v1 {

Status View::makeAir() {
  Status status = sky::createAirSetLayout(device_, &airLayout_);
  const bool sliced = slice_ != nullptr && desc_.solver == Solver::Moments &&
                      desc_.projection != Projection::Orthographic;
  if (status != Status::Ok || !sliced) return status;
  status = sky::AirVolume::create(resources_, desc_.without, &volume_);
  if (status != Status::Ok) return status;
  return sky::createAirSet(resources_, *volume_, airLayout_, &airPool_, &airSet_);
}

Status View::makeAirPipelines() {
  Status status = Status::Ok;
  if (!desc_.alwaysSliced || volume_ == nullptr) status = makeAirPipeline(false, &airPipeline_);
  if (status == Status::Ok && volume_ != nullptr)
    status = makeAirPipeline(true, &airVolumePipeline_);
  return status;
}

Status View::makeAirPipeline(bool fromVolume, VkPipeline* out) {
  namespace s = alpenglow::shaders;
  const bool reversed = desc_.depth == DepthConvention::Reversed;
  const bool shafts = shafts_.layout != VK_NULL_HANDLE;
  engine::GraphicsPipelineDesc desc;
  desc.vertex = {s::kSkyVertex, sizeof s::kSkyVertex, "sky.vert"};
  desc.fragment = sky::airShader(desc_.solver, desc_.without, fromVolume, shafts);
  engine::SpecConstant constants[5 + bake::kEffectConstants] = {
      engine::specFloat(4, reversed ? 0.0f : 1.0f),
      engine::specBool(6, desc_.projection == Projection::Orthographic),
      engine::specUint(8, shafts_.method), engine::specUint(9, shafts_.samples),
      engine::specFloat(10, shafts_.multipleLoss)};
  std::ranges::copy(bake::effectConstants(desc_.without), constants + 5);
  desc.constants = constants;
  desc.constantCount = 5 + bake::kEffectConstants;
  desc.layout = layout_;
  desc.colors[0] = {desc_.colorFormat, engine::Blend::DualSource};
  desc.depthFormat = desc_.depthFormat;
  desc.renderPass = desc_.renderPass;
  desc.subpass = desc_.subpass;
  // Drawn at the far plane: what is nearer passes.
  desc.depthTest = desc_.depthFormat != VK_FORMAT_UNDEFINED;
  desc.depthCompare = reversed ? VK_COMPARE_OP_LESS : VK_COMPARE_OP_GREATER;
  return engine::createGraphicsPipeline(device_, desc, out);
}

VkDescriptorSet View::airSet(const Tables& tables, const SkyDraw& draw) const {
  return volume_ != nullptr && volume_->serves(tables, draw) ? airSet_ : VK_NULL_HANDLE;
}

Status View::recordAir(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw) {
  if (!hasAir()) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "recordAir got a view without a scene, but needs one made with "
                        "ViewDesc::sceneDepth.");
  }
  Status status = sky::checkDepthRange(device_, desc_.projection, draw.depth);
  const bool fromVolume = airSet(tables, draw) != VK_NULL_HANDLE;
  if (status == Status::Ok && fromVolume) status = volume_->assertReadable();
  if (status == Status::Ok && !fromVolume && airPipeline_ == VK_NULL_HANDLE)
    status = refuseUnsliced("recordAir");
  if (status != Status::Ok) return status;

  const engine::Dispatch& vk = device_.vk();
  const sky::AirConstants constants = sky::makeAirConstants(tables.parameters(), desc_, draw);
  engine::setArea(device_, commands, draw.viewport);
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS,
                     fromVolume ? airVolumePipeline_ : airPipeline_);
  bindSets(commands, tables);
  vk.CmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                      &constants);
  vk.CmdDraw(commands, 3, 1, 0, 0);
  ++device_.counters().draws;
  return Status::Ok;
}

}  // namespace v1
}  // namespace alpenglow
