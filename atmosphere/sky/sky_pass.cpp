#include "atmosphere/sky/sky_pass.h"

#include <alpenglow/shaders/sky_vertex.h>

#include <algorithm>
#include <new>

#include "atmosphere/bake/effect_constants.h"
#include "atmosphere/model/solvers.h"
#include "atmosphere/sky/shader_choice.h"

namespace alpenglow {
inline namespace v1 {

Status View::create(bake::Resources& resources, const ViewDesc& desc, const sky::ShaftSet& shafts,
                    View** out) {
  *out = nullptr;
  engine::Device& device = resources.device();
  auto* view = new (std::nothrow) View(resources, desc, shafts);
  if (view == nullptr) {
    return device.fail(Status::OutOfHostMemory, VK_SUCCESS, "A view found no host memory.");
  }
  ++resources.live().views;
  Status status = view->makeSlice();
  if (status == Status::Ok) status = view->makeLayout();
  if (status == Status::Ok && !desc.alwaysSliced)
    status = view->makePipelines(false, view->pipelines_);
  if (status == Status::Ok && view->slice_ != nullptr)
    status = view->makePipelines(true, view->slicePipelines_);
  if (status == Status::Ok && view->hasAir()) status = view->makeAirPipelines();
  if (status != Status::Ok) {
    destroy(view, 0);  // Nothing was recorded with it: frame 0 has always completed.
    return status;
  }
  *out = view;
  return Status::Ok;
}

void View::destroy(View* view, uint64_t frame) {
  if (view == nullptr) return;
  --view->resources_.live().views;
  engine::Device& device = view->device_;
  engine::DeletionQueue& deletions = device.deletions();
  for (const auto* pipelines : {&view->pipelines_, &view->slicePipelines_})
    for (VkPipeline pipeline : *pipelines)
      deletions.defer(frame, VK_OBJECT_TYPE_PIPELINE, engine::handleNumber(pipeline));
  for (VkPipeline pipeline : {view->airPipeline_, view->airVolumePipeline_})
    deletions.defer(frame, VK_OBJECT_TYPE_PIPELINE, engine::handleNumber(pipeline));
  deletions.defer(frame, VK_OBJECT_TYPE_PIPELINE_LAYOUT,
                  engine::handleNumber(view->layout_));
  deletions.defer(frame, VK_OBJECT_TYPE_DESCRIPTOR_POOL,
                  engine::handleNumber(view->pool_));
  deletions.defer(frame, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT,
                  engine::handleNumber(view->setLayout_));
  deletions.defer(frame, VK_OBJECT_TYPE_DESCRIPTOR_POOL,
                  engine::handleNumber(view->airPool_));
  deletions.defer(frame, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT,
                  engine::handleNumber(view->airLayout_));
  sky::AirVolume::destroy(view->volume_, frame);
  sky::SkySlice::destroy(view->slice_, frame);
  delete view;
  deletions.collect(device.completed());
}

Status View::makeSlice() {
  if (desc_.skySlice == nullptr) return Status::Ok;
  const TableDesc tables = desc_.skySlice->desc();
  if (tables.mie != desc_.mie || tables.solver != desc_.solver ||
      &desc_.skySlice->resources() != &resources_) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "ViewDesc::skySlice has tables %s, but needs tables of the view's context "
                        "with the solver and the MieStorage that ViewDesc names.",
                        &desc_.skySlice->resources() != &resources_ ? "of another context"
                        : tables.solver != desc_.solver             ? "of another solver"
                                                                    : "with another MieStorage");
  }
  if (tables.disabledEffects != (desc_.without & kTableEffects)) return refuseEffects(tables.disabledEffects);
  desc_.skySlice = nullptr;  // Only their shape counts: they may be destroyed before the view.
  // Orthographic cameras have an observer a pixel; most of the simpler models have no slice.
  if (desc_.projection == Projection::Orthographic || !hasSkySlice(desc_.solver)) return Status::Ok;
  return sky::SkySlice::create(resources_, tables, desc_.without, &slice_);
}

// Set 1 of the fragment shaders: the albedo map at binding 0, the slice at 1 and 2, the scene's
// depth at 3; what there is of it. Set 2 is the air volume's, set 3 the shafts'.
Status View::makeLayout() {
  VkDescriptorSetLayoutBinding bindings[4];
  uint32_t count = 0;
  const auto add = [&](uint32_t binding) {
    bindings[count++] = {binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                         VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
  };
  if (desc_.groundAlbedo.view != VK_NULL_HANDLE) add(0);
  if (slice_ != nullptr) {
    add(1);
    add(2);
  }
  if (hasAir()) add(3);
  if (count > 0) {
    const Status status = makeSet(bindings, count);
    if (status != Status::Ok) return status;
  }
  if (hasAir()) {
    const Status status = makeAir();
    if (status != Status::Ok) return status;
  }
  VkDescriptorSetLayout sets[4] = {resources_.tableLayout(), setLayout_, airLayout_,
                                   shafts_.layout};
  const uint32_t setCount = hasAir() ? shafts_.layout != VK_NULL_HANDLE ? 4 : 3 : count > 0 ? 2 : 1;
  const VkPushConstantRange range = {VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(sky::SkyConstants)};
  return engine::createPipelineLayout(device_, sets, setCount, &range, 1, "Alpenglow sky",
                                      &layout_);
}

Status View::makeSet(const VkDescriptorSetLayoutBinding* bindings, uint32_t count) {
  Status status = engine::createSetLayout(device_, bindings, count, "Alpenglow view", &setLayout_);
  if (status != Status::Ok) return status;
  const engine::PoolPart part = {bindings, count, 1};
  status = engine::createPool(device_, &part, 1, "Alpenglow view", &pool_);
  if (status != Status::Ok) return status;
  status = engine::allocateSets(device_, pool_, &setLayout_, 1, "Alpenglow view", &set_);
  if (status != Status::Ok) return status;
  engine::DescriptorWriter writer(set_);
  if (desc_.groundAlbedo.view != VK_NULL_HANDLE) {
    writer.sampledImage(0, desc_.groundAlbedo.view, desc_.groundAlbedo.sampler,
                        desc_.groundAlbedo.layout);
  }
  if (slice_ != nullptr) {
    writer.sampledImage(1, slice_->image().view, resources_.sampler())
        .sampledImage(2, slice_->mieImage().view, resources_.sampler());
  }
  if (hasAir())
    writer.sampledImage(3, desc_.sceneDepth.view, resources_.nearestSampler(),
                        desc_.sceneDepth.layout);
  return writer.flush(device_);
}

Status View::makePipelines(bool slice, VkPipeline* pipelines) {
  namespace s = alpenglow::shaders;
  const bool reversed = desc_.depth == DepthConvention::Reversed;
  engine::GraphicsPipelineDesc desc;
  desc.vertex = {s::kSkyVertex, sizeof s::kSkyVertex, "sky.vert"};
  const bool map = desc_.groundAlbedo.view != VK_NULL_HANDLE;
  desc.fragment =
      sky::skyShader(desc_.solver, desc_.without, {map, slice, shafts_.layout != VK_NULL_HANDLE});
  desc.layout = layout_;
  desc.colors[0].format = desc_.colorFormat;
  desc.depthFormat = desc_.depthFormat;
  desc.samples = desc_.samples;
  desc.renderPass = desc_.renderPass;
  desc.subpass = desc_.subpass;
  desc.depthTest = desc_.depthFormat != VK_FORMAT_UNDEFINED;
  desc.depthCompare = reversed ? VK_COMPARE_OP_GREATER_OR_EQUAL : VK_COMPARE_OP_LESS_OR_EQUAL;
  for (const sky::Visible seen : sky::kCombinations) {
    if (!sky::drawn(desc_.without, seen)) continue;
    engine::SpecConstant constants[12 + bake::kEffectConstants] = {
        engine::specBool(0, desc_.mie == MieStorage::Packed),
        engine::specBool(1, desc_.projection == Projection::Fisheye),
        engine::specBool(2, seen.ground),
        engine::specBool(3, seen.disc),
        engine::specFloat(4, reversed ? 0.0f : 1.0f),
        engine::specBool(5, seen.air),
        engine::specBool(6, desc_.projection == Projection::Orthographic),
        engine::specUint(8, shafts_.method),
        engine::specUint(9, shafts_.samples),
        engine::specFloat(10, shafts_.multipleLoss),
        engine::specFloat(11, static_cast<float>(slice ? slice_->columns() : 0)),
        engine::specFloat(12, static_cast<float>(slice ? slice_->rows() : 0))};
    std::ranges::copy(bake::effectConstants(desc_.without), constants + 12);
    desc.constants = constants;
    desc.constantCount = 12 + bake::kEffectConstants;
    const Status status =
        engine::createGraphicsPipeline(device_, desc, &pipelines[sky::variant(seen)]);
    if (status != Status::Ok) return status;
  }
  return Status::Ok;
}

Status View::checkRecord(const Tables& tables, const SkyDraw& draw, const char* call) const {
  const Status status = sky::checkDraw(device_, desc_.projection, draw);
  if (status != Status::Ok) return status;
  if (&tables.resources() != &resources_) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "%s got tables of another context, but a view draws with those of its own.",
                        call);
  }
  if (tables.desc().solver != desc_.solver) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "The tables are of Solver::%s, but ViewDesc::solver says %s.",
                        solverEnumerator(tables.desc().solver), solverEnumerator(desc_.solver));
  }
  if (tables.desc().mie != desc_.mie) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "The tables store single Mie scattering %s, but ViewDesc::mie says %s.",
                        tables.desc().mie == MieStorage::Full ? "in full" : "packed",
                        desc_.mie == MieStorage::Full ? "in full" : "packed");
  }
  if (tables.desc().disabledEffects != (desc_.without & kTableEffects))
    return refuseEffects(tables.desc().disabledEffects);
  const Status seen = sky::checkDrawnEffects(device_, tables.parameters(), desc_, draw);
  return seen == Status::Ok ? tables.assertReadable() : seen;
}

Status View::refuseEffects(EffectFlags tables) const {
  return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                      "The tables are without the effects 0x%x (TableDesc::disabledEffects), but the view "
                      "draws tables without 0x%x (ViewDesc::without): they must agree.",
                      tables, desc_.without & kTableEffects);
}

Status View::refuseUnsliced(const char* call) const {
  return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                      "%s got a draw that no recordSkySlice came before, but the view is "
                      "alwaysSliced: record the slice of these tables, camera and sun first.",
                      call);
}

Status View::recordSlice(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw) {
  const Status status = checkRecord(tables, draw, "recordSkySlice");
  if (status != Status::Ok) return status;
  const bool none = desc_.projection == Projection::Orthographic || !hasSkySlice(desc_.solver);
  if (slice_ == nullptr && none) return Status::Ok;
  if (slice_ == nullptr) {
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "recordSkySlice got a view without a slice, but needs one made with "
                        "ViewDesc::skySlice.");
  }
  if (!slice_->fits(tables)) {
    const TableSizes& sizes = tables.desc().sizes;  // the slices of moments are all alike
    return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                        "recordSkySlice got tables with %u mu and %u nu, but the view's slice was "
                        "made for another shape.",
                        sizes.scatteringMu, sizes.scatteringNu);
  }
  if (!sky::SkySlice::possible(tables, draw)) return Status::Ok;
  const Status recorded = slice_->record(commands, tables, draw);
  return recorded == Status::Ok && volume_ != nullptr ? volume_->record(commands, tables, draw)
                                                      : recorded;
}

Status View::recordSky(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw) {
  const bool fromSlice = slice_ != nullptr && slice_->serves(tables, draw);
  Status status = fromSlice ? slice_->assertReadable() : Status::Ok;
  if (fromSlice && status == Status::Ok && volume_ != nullptr) status = volume_->assertReadable();
  if (!fromSlice && desc_.alwaysSliced) status = refuseUnsliced("recordSky");
  if (status != Status::Ok) return status;
  const sky::Parts parts = sky::cut(tables.parameters(), desc_, draw);
  status = sky::checkParts(device_, desc_, parts);
  if (status != Status::Ok) return status;

  const engine::Dispatch& vk = device_.vk();
  const sky::SkyConstants constants = sky::makeConstants(tables.parameters(), desc_, draw);
  engine::setArea(device_, commands, draw.viewport);  // the parts set scissors of their own
  bindSets(commands, tables);
  vk.CmdPushConstants(commands, layout_, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof constants,
                      &constants);
  drawParts(commands, parts, draw.viewport.offset, fromSlice ? slicePipelines_ : pipelines_);
  return Status::Ok;
}

void View::bindSets(VkCommandBuffer commands, const Tables& tables) {
  const VkDescriptorSet sets[4] = {tables.descriptorSet(), set_, airSet_, shafts_.set};
  const auto bind = [&](uint32_t first, uint32_t count) {
    device_.vk().CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, first,
                                       count, sets + first, 0, nullptr);
  };
  bind(0, set_ != VK_NULL_HANDLE ? 2 : 1);
  if (airSet_ != VK_NULL_HANDLE) bind(2, 1);
  if (shafts_.layout != VK_NULL_HANDLE) bind(3, 1);
}

void View::drawParts(VkCommandBuffer commands, const sky::Parts& parts, const VkOffset2D& corner,
                     const VkPipeline* pipelines) {
  const engine::Dispatch& vk = device_.vk();
  VkPipeline bound = VK_NULL_HANDLE;
  for (const sky::Visible seen : sky::kCombinations) {
    for (uint32_t i = 0; i < parts.count; ++i) {
      const sky::Part& part = parts.parts[i];
      if (!(part.visible == seen)) continue;
      if (pipelines[sky::variant(seen)] != bound) {
        bound = pipelines[sky::variant(seen)];
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

}  // namespace v1
}  // namespace alpenglow
