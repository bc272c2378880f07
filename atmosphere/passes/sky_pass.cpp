#include "atmosphere/passes/sky_pass.h"

#include <alpenglow/shaders/sky_vertex.h>

#include <algorithm>

#include "atmosphere/passes/shader_choice.h"
#include "atmosphere/tables/effect_constants.h"

namespace alpenglow::passes {

void PictureSets::bind(const engine::Device& device, VkCommandBuffer commands,
                       VkPipelineLayout layout) const {
  for (uint32_t i = 0; i < kViewSetCount; ++i) {
    if (sets[i] == VK_NULL_HANDLE) continue;
    device.vk().CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, i, 1,
                                      &sets[i], 0, nullptr);
  }
}

Status SkyPass::make(const PictureDesc& desc, const LightShaftSet& shafts, const SkyViewLut* lut,
                     VkPipelineLayout layout) {
  layout_ = layout;
  Status status = Status::Ok;
  if (!desc.onlyLut) status = makePipelines(desc, shafts, nullptr, pipelines_);
  if (status == Status::Ok && lut != nullptr)
    status = makePipelines(desc, shafts, lut, lutPipelines_);
  return status;
}

void SkyPass::destroy(uint64_t frame) {
  for (const auto* pipelines : {&pipelines_, &lutPipelines_})
    for (VkPipeline pipeline : *pipelines)
      device_.deletions().defer(frame, VK_OBJECT_TYPE_PIPELINE, engine::handleNumber(pipeline));
}

Status SkyPass::makePipelines(const PictureDesc& desc, const LightShaftSet& shafts,
                              const SkyViewLut* lut, VkPipeline* pipelines) {
  namespace s = alpenglow::shaders;
  const bool reversed = desc.depth == DepthConvention::Reversed;
  engine::GraphicsPipelineDesc pipeline;
  pipeline.vertex = {s::kSkyVertex, sizeof s::kSkyVertex, "sky.vert"};
  const bool map = desc.groundAlbedo.view != VK_NULL_HANDLE;
  pipeline.fragment = skyShader(desc.solver, desc.disabledEffects,
                                {map, lut != nullptr, shafts.layout != VK_NULL_HANDLE});
  pipeline.layout = layout_;
  pipeline.colors[0].format = desc.colorFormat;
  pipeline.depthFormat = desc.depthFormat;
  pipeline.samples = desc.samples;
  pipeline.renderPass = desc.renderPass;
  pipeline.subpass = desc.subpass;
  pipeline.depthTest = desc.depthFormat != VK_FORMAT_UNDEFINED;
  pipeline.depthCompare = reversed ? VK_COMPARE_OP_GREATER_OR_EQUAL : VK_COMPARE_OP_LESS_OR_EQUAL;
  for (const Visible seen : kCombinations) {
    if (!drawn(desc.disabledEffects, seen)) continue;
    engine::SpecConstant constants[12 + tables::kEffectConstants] = {
        engine::specBool(0, desc.mie == MieStorage::Packed),
        engine::specBool(1, desc.projection == Projection::Fisheye),
        engine::specBool(2, seen.ground),
        engine::specBool(3, seen.disc),
        engine::specFloat(4, reversed ? 0.0f : 1.0f),
        engine::specBool(5, seen.atmosphere),
        engine::specBool(6, desc.projection == Projection::Orthographic),
        engine::specUint(8, shafts.method),
        engine::specUint(9, shafts.stepCount),
        engine::specFloat(10, shafts.multipleLoss),
        engine::specFloat(11, static_cast<float>(lut != nullptr ? lut->columns() : 0)),
        engine::specFloat(12, static_cast<float>(lut != nullptr ? lut->rows() : 0))};
    std::ranges::copy(tables::effectConstants(desc.disabledEffects), constants + 12);
    pipeline.constants = constants;
    pipeline.constantCount = 12 + tables::kEffectConstants;
    const Status status =
        engine::createGraphicsPipeline(device_, pipeline, &pipelines[variant(seen)]);
    if (status != Status::Ok) return status;
  }
  return Status::Ok;
}

void SkyPass::record(VkCommandBuffer commands, const SkyConstants& constants,
                     const PictureSets& sets, const VkRect2D& viewport,
                     const ViewportPartition& parts, bool fromLut) {
  const engine::Dispatch& vk = device_.vk();
  engine::setArea(device_, commands, viewport);  // The parts set scissors of their own.
  sets.bind(device_, commands, layout_);
  vk.CmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                      &constants);
  const VkPipeline* pipelines = fromLut ? lutPipelines_ : pipelines_;
  const VkOffset2D& corner = viewport.offset;
  VkPipeline bound = VK_NULL_HANDLE;
  for (const Visible seen : kCombinations) {
    for (uint32_t i = 0; i < parts.count; ++i) {
      const Part& part = parts.parts[i];
      if (!(part.visible == seen)) continue;
      if (pipelines[variant(seen)] != bound) {
        bound = pipelines[variant(seen)];
        vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, bound);
      }
      VkRect2D scissor = part.area;
      scissor.offset.x += corner.x;
      scissor.offset.y += corner.y;
      vk.CmdSetScissor(commands, 0, 1, &scissor);
      vk.CmdDraw(commands, 3, 1, 0, 0);
      ++device_.counters().draws;
    }
  }
}

}  // namespace alpenglow::passes
