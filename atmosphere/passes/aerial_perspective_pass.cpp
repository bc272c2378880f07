// Aerial perspective over a host's scene.
#include <alpenglow/shaders/sky_vertex.h>

#include <algorithm>

#include "atmosphere/passes/shader_choice.h"
#include "atmosphere/passes/sky_pass.h"
#include "atmosphere/tables/effect_constants.h"

namespace alpenglow::passes {

Status AerialPerspectivePass::make(const PictureDesc& desc, const LightShaftSet& shafts,
                                   VkPipelineLayout layout) {
  layout_ = layout;
  return desc.aerialLut ? makePipeline(desc, shafts, true, &lutPipeline_)
                        : makePipeline(desc, shafts, false, &pipeline_);
}

void AerialPerspectivePass::destroy(uint64_t frame) {
  for (VkPipeline pipeline : {pipeline_, lutPipeline_})
    device_.deletions().defer(frame, VK_OBJECT_TYPE_PIPELINE, engine::handleNumber(pipeline));
}

Status AerialPerspectivePass::makePipeline(const PictureDesc& desc, const LightShaftSet& shafts,
                                           bool fromLut, VkPipeline* out) {
  namespace s = alpenglow::shaders;
  const bool reversed = desc.depth == DepthConvention::Reversed;
  engine::GraphicsPipelineDesc pipeline;
  pipeline.vertex = {s::kSkyVertex, sizeof s::kSkyVertex, "sky.vert"};
  pipeline.fragment = aerialPerspectiveShader(desc.solver, desc.disabledEffects, fromLut,
                                              shafts.layout != VK_NULL_HANDLE);
  engine::SpecConstant constants[5 + tables::kEffectConstants] = {
      engine::specFloat(4, reversed ? 0.0f : 1.0f),
      engine::specBool(6, desc.projection == Projection::Orthographic),
      engine::specUint(8, shafts.method), engine::specUint(9, shafts.stepCount),
      engine::specFloat(10, shafts.multipleLoss)};
  std::ranges::copy(tables::effectConstants(desc.disabledEffects), constants + 5);
  pipeline.constants = constants;
  pipeline.constantCount = 5 + tables::kEffectConstants;
  pipeline.layout = layout_;
  pipeline.colors[0] = {desc.colorFormat, engine::Blend::DualSource};
  pipeline.depthFormat = desc.depthFormat;
  pipeline.renderPass = desc.renderPass;
  pipeline.subpass = desc.subpass;
  // Drawn at the far plane: what is nearer passes.
  pipeline.depthTest = desc.depthFormat != VK_FORMAT_UNDEFINED;
  pipeline.depthCompare = reversed ? VK_COMPARE_OP_LESS : VK_COMPARE_OP_GREATER;
  return engine::createGraphicsPipeline(device_, pipeline, out);
}

void AerialPerspectivePass::record(VkCommandBuffer commands,
                                   const AerialPerspectiveConstants& constants,
                                   const PictureSets& sets, const VkRect2D& viewport,
                                   bool fromLut) {
  const engine::Dispatch& vk = device_.vk();
  engine::setArea(device_, commands, viewport);
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, fromLut ? lutPipeline_ : pipeline_);
  sets.bind(device_, commands, layout_);
  vk.CmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                      &constants);
  vk.CmdDraw(commands, 3, 1, 0, 0);
  ++device_.counters().draws;
}

}  // namespace alpenglow::passes
