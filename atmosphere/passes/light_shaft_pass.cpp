#include "atmosphere/passes/light_shaft_pass.h"

#include <alpenglow/shaders/light_volume_cull.h>
#include <alpenglow/shaders/light_volume_mesh_vertex.h>
#include <alpenglow/shaders/shadow_volume_caster.h>
#include <alpenglow/shaders/shadow_volume_fragment.h>
#include <alpenglow/shaders/shadow_volume_geometry.h>

#include <algorithm>
#include <limits>

#include "atmosphere/camera/projection.h"
#include "atmosphere/passes/aerial_perspective_set.h"
#include "atmosphere/passes/shader_choice.h"
#include "atmosphere/tables/effect_constants.h"
#include "engine/barriers.h"
#include "engine/structure.h"

namespace alpenglow::passes {
namespace {

constexpr VkShaderStageFlags kMapStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
constexpr VkDescriptorSetLayoutBinding sampled(uint32_t binding, VkShaderStageFlags stages) {
  return {binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, stages, nullptr};
}
constexpr uint32_t kBindingCount = 5;

/// Bytes before the list of AlpenglowLightShaftBlocks.
constexpr VkDeviceSize kBlocksHead = 20;

/// Sums of light: floats where they can be blended.
VkFormat sumFormat(const engine::Device& device) {
  const VkFormatFeatureFlags features =
      device.formatProperties(VK_FORMAT_R32G32B32A32_SFLOAT).optimalTilingFeatures;
  return (features & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) != 0
             ? VK_FORMAT_R32G32B32A32_SFLOAT
             : VK_FORMAT_R16G16B16A16_SFLOAT;
}

}  // namespace

Status LightShaftPass::make(const LightShaftSettings& desc, VkShaderStageFlags stages) {
  desc_ = desc;
  stages_ = stages;
  Status status = mapped() ? map_.make(desc_) : Status::Ok;
  if (status == Status::Ok) status = makeBuffers();
  if (status == Status::Ok) status = makeLayout();
  if (status == Status::Ok && desc_.method != LightShaftMethod::RayMarch) status = makePipelines();
  if (status == Status::Ok && exact()) status = makeCulling();
  return status;
}

void LightShaftPass::destroy(uint64_t frame) {
  engine::DeletionQueue& deletions = device_.deletions();
  const auto defer = [&](VkObjectType type, auto handle) {
    deletions.defer(frame, type, engine::handleNumber(handle));
  };
  defer(VK_OBJECT_TYPE_PIPELINE, pipeline_);
  defer(VK_OBJECT_TYPE_PIPELINE, lutPipeline_);
  defer(VK_OBJECT_TYPE_PIPELINE, cullPipeline_);
  defer(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout_);
  defer(VK_OBJECT_TYPE_PIPELINE_LAYOUT, cullLayout_);
  dropTargets(frame);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, setLayout_);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, lutLayout_);
  engine::deferBuffer(device_, frame, &frame_);
  engine::deferBuffer(device_, frame, &blocks_);
  engine::deferBlock(device_, frame, &bufferMemory_);
  map_.destroy(frame);
}

void LightShaftPass::dropTargets(uint64_t frame) {
  device_.deletions().defer(frame, VK_OBJECT_TYPE_DESCRIPTOR_POOL, engine::handleNumber(pool_));
  pool_ = VK_NULL_HANDLE;
  set_ = VK_NULL_HANDLE;
  for (engine::Image& image : targets_) {
    engine::deferImage(device_, frame, &image);
    image = {};
  }
  engine::deferBlock(device_, frame, &targetMemory_);
  targetMemory_ = {};
  targetCount_ = 0;
  extent_ = {};
}

Status LightShaftPass::resize(VkExtent2D scene) {
  if (scene.width == extent_.width && scene.height == extent_.height) return Status::Ok;
  dropTargets(device_.submitting());
  extent_ = scene;
  Status status = makeTargets();
  if (status == Status::Ok) status = makeSet();
  if (status != Status::Ok) dropTargets(device_.submitting());
  return status;
}

Status LightShaftPass::makeBuffers() {
  Status status =
      engine::createBuffer(device_, sizeof(LightShaftFrame),
                           VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                               VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                           "Alpenglow shaft frame", &frame_);
  if (status != Status::Ok) return status;
  const uint32_t side = blocksAcross(desc_);
  if (exact()) {
    status = engine::createBuffer(device_, kBlocksHead + VkDeviceSize{4} * side * side,
                                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                      VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                  "Alpenglow shaft blocks", &blocks_);
    if (status != Status::Ok) return status;
  }
  engine::Buffer* buffers[] = {&frame_, &blocks_};
  return engine::allocateAndBind(device_, "Alpenglow shafts", VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                 nullptr, 0, buffers, exact() ? 2 : 1, &bufferMemory_);
}

VkFormat LightShaftPass::targetFormat() const {
  return desc_.method == LightShaftMethod::ShadowVolume ? VK_FORMAT_R32G32_SFLOAT
                                                        : sumFormat(device_);
}

Status LightShaftPass::makeTargets() {
  engine::Image* images[] = {&targets_[0], &targets_[1]};
  for (uint32_t i = 0; i < wantedTargets(); ++i) {
    engine::ImageDesc image;
    image.format = targetFormat();
    image.extent = {extent_.width, extent_.height, 1};
    image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                  VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    image.linearFilter = false;
    image.name = i == 0 ? "Alpenglow shaft sums" : "Alpenglow shaft bounds";
    const Status status = engine::createImage(device_, image, &targets_[i]);
    if (status != Status::Ok) return status;
    ++targetCount_;
  }
  if (targetCount_ == 0) return Status::Ok;
  return engine::allocateAndBind(device_, "Alpenglow shaft targets",
                                 VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, images, targetCount_, nullptr,
                                 0, &targetMemory_);
}

// AlpenglowLightShaftFrame, shadow map, sums, bounds, blocks.
void LightShaftPass::describeBindings(VkDescriptorSetLayoutBinding* bindings) const {
  const VkShaderStageFlags geometry =
      desc_.method == LightShaftMethod::ShadowVolume ? VK_SHADER_STAGE_GEOMETRY_BIT : 0;
  bindings[0] = {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, stages_ | kMapStages | geometry, nullptr};
  bindings[1] = sampled(1, stages_ | kMapStages | geometry);
  bindings[2] = sampled(2, stages_);
  bindings[3] = sampled(3, stages_);
  bindings[4] = {4, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, stages_ | kMapStages, nullptr};
}

Status LightShaftPass::makeLayout() {
  VkDescriptorSetLayoutBinding bindings[kBindingCount];
  describeBindings(bindings);
  return engine::createSetLayout(device_, bindings, kBindingCount, "Alpenglow shafts", &setLayout_);
}

Status LightShaftPass::makeSet() {
  VkDescriptorSetLayoutBinding bindings[kBindingCount];
  describeBindings(bindings);
  const engine::PoolPart part = {bindings, kBindingCount, 1};
  Status status = engine::createPool(device_, &part, 1, "Alpenglow shafts", &pool_);
  if (status == Status::Ok)
    status = engine::allocateSets(device_, pool_, &setLayout_, 1, "Alpenglow shafts", &set_);
  if (status != Status::Ok) return status;
  // Shaders declare the bindings of all methods: another image fills those that a method lacks.
  const VkImageView map = mapped() ? map_.depth().view : targets_[0].view;
  const VkImageView sums = targetCount_ > 0 ? targets_[0].view : map;
  const VkImageView bounds = targetCount_ > 1 ? targets_[1].view : sums;
  const VkSampler sampler = resources_.nearestSampler();
  engine::DescriptorWriter writer(set_);
  writer.uniformBuffer(0, frame_.handle)
      .sampledImage(1, map, sampler)
      .sampledImage(2, sums, sampler)
      .sampledImage(3, bounds, sampler)
      .storageBuffer(4, exact() ? blocks_.handle : frame_.handle);
  return writer.flush(device_);
}

Status LightShaftPass::makePipelines() {
  Status status = passes::createAerialPerspectiveSetLayout(device_, stages_, &lutLayout_);
  if (status != Status::Ok) return status;
  const VkDescriptorSetLayout sets[] = {resources_.tableLayout(), setLayout_, lutLayout_};
  status =
      engine::createPipelineLayout(device_, sets, 3, &kPlaceRange, 1, "Alpenglow shafts", &layout_);
  if (status == Status::Ok) status = makePipeline(false, &pipeline_);
  if (status == Status::Ok && looksUp()) status = makePipeline(true, &lutPipeline_);
  return status;
}

Status LightShaftPass::makeCulling() {
  namespace s = alpenglow::shaders;
  const Status status = engine::createPipelineLayout(device_, &setLayout_, 1, nullptr, 0,
                                                     "Alpenglow shaft blocks", &cullLayout_);
  if (status != Status::Ok) return status;
  engine::ComputePipelineDesc desc;
  desc.shader = {s::kLightVolumeCull, sizeof s::kLightVolumeCull, "light_volume_cull.comp"};
  desc.layout = cullLayout_;
  return engine::createComputePipeline(device_, desc, &cullPipeline_);
}

Status LightShaftPass::makePipeline(bool fromLut, VkPipeline* out) {
  namespace s = alpenglow::shaders;
  const bool reversed = desc_.depth == DepthConvention::Reversed;
  engine::GraphicsPipelineDesc desc;
  desc.colors[0] = {targetFormat(), engine::Blend::Add};
  if (exact()) {
    desc.vertex = {s::kLightVolumeMeshVertex, sizeof s::kLightVolumeMeshVertex,
                   "light_volume_mesh.vert"};
    desc.fragment = passes::lightVolumeMeshShader(desc_.disabledEffects, fromLut);
    desc.topology = engine::Topology::TriangleStrip;
  } else {
    desc.vertex = {s::kShadowVolumeCaster, sizeof s::kShadowVolumeCaster, "caster.vert"};
    desc.geometry = {s::kShadowVolumeGeometry, sizeof s::kShadowVolumeGeometry,
                     "shadow_volume.geom"};
    desc.fragment = {s::kShadowVolumeFragment, sizeof s::kShadowVolumeFragment,
                     "shadow_volume.frag"};
    desc.colors[1] = {targetFormat(), engine::Blend::Max};
    desc.vertices = {desc_.vertexStride, desc_.vertexOffset};
    desc.topology = engine::Topology::TrianglesWithAdjacency;
  }
  engine::SpecConstant constants[2 + tables::kEffectConstants] = {
      engine::specBool(6, desc_.projection == Projection::Orthographic),
      engine::specBool(7, reversed)};
  std::ranges::copy(tables::effectConstants(desc_.disabledEffects), constants + 2);
  desc.constants = constants;
  desc.constantCount = 2 + tables::kEffectConstants;
  desc.layout = layout_;
  desc.depthFormat = desc_.sceneDepthFormat;
  desc.stencil = false;
  desc.depthTest = true;
  desc.depthClamp = true;  // casters beyond the far plane shadow the sky
  desc.depthCompare = reversed ? VK_COMPARE_OP_GREATER_OR_EQUAL : VK_COMPARE_OP_LESS_OR_EQUAL;
  return engine::createGraphicsPipeline(device_, desc, out);
}

Status LightShaftPass::recordShadowMap(VkCommandBuffer commands, const double sun[3],
                                       const CasterSet& casters) {
  if (!mapped() || map_.current(sun, casters)) return Status::Ok;
  return map_.record(commands, sun, casters);
}

Status LightShaftPass::record(VkCommandBuffer commands, const Tables& tables,
                              const FrameState& draw, const HostImage& sceneDepth,
                              const CasterSet& casters, VkDescriptorSet lut) {
  Status status = updateFrame(
      commands, makeLightShaftFrame(tables.parameters(), desc_, map_.place(), draw, casters.lit));
  if (status == Status::Ok && !casters.lit) return recordNone(commands);
  if (status == Status::Ok && exact()) status = cullBlocks(commands);
  if (status == Status::Ok && targetCount_ > 0)
    status = drawShadows(commands, tables, draw, sceneDepth, casters, lut);
  return status;
}

// No shader reads the images then, but they must be in the layout that the set states.
Status LightShaftPass::recordNone(VkCommandBuffer commands) {
  engine::Barriers barriers;
  for (uint32_t i = 0; i < targetCount_; ++i)
    barriers.discard(targets_[i], engine::kFragmentSampled);
  const Status status = barriers.record(device_, commands);
  return status == Status::Ok && mapped() ? map_.recordReadable(commands) : status;
}

Status LightShaftPass::updateFrame(VkCommandBuffer commands, const LightShaftFrame& frame) {
  constexpr VkPipelineStageFlags2 kReaders =
      VK_PIPELINE_STAGE_2_ALL_GRAPHICS_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  engine::Barriers barriers;
  barriers.memory(kReaders, VK_ACCESS_2_NONE,
                  VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
                  VK_ACCESS_2_TRANSFER_WRITE_BIT);
  Status status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  device_.vk().CmdUpdateBuffer(commands, frame_.handle, 0, sizeof frame, &frame);
  barriers.memory(VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, kReaders,
                  // As storage where it stands in for the blocks.
                  VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
  return barriers.record(device_, commands);
}

Status LightShaftPass::cullBlocks(VkCommandBuffer commands) {
  const engine::Dispatch& vk = device_.vk();
  const uint32_t side = blocksAcross(desc_);
  const uint32_t strip = 2 * kLightShaftBlock + 4;
  const VkDrawIndirectCommand none = {strip * kLightShaftBlock, 0, 0, 0};
  vk.CmdUpdateBuffer(commands, blocks_.handle, 0, sizeof none, &none);
  engine::Barriers barriers;
  barriers.memory(VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                  VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                  VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                      VK_ACCESS_2_UNIFORM_READ_BIT);
  Status status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, cullPipeline_);
  vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, cullLayout_, 0, 1, &set_, 0,
                           nullptr);
  vk.CmdDispatch(commands, (side * side + 63) / 64, 1, 1);
  ++device_.counters().dispatches;
  barriers.memory(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                  VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT | VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                      VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                  VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
  return barriers.record(device_, commands);
}

void LightShaftPass::drawSurface(VkCommandBuffer commands, const FrameState& draw,
                                 VkPipeline pipeline) {
  const engine::Dispatch& vk = device_.vk();
  engine::setArea(device_, commands, draw.viewport);
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  vk.CmdDrawIndirect(commands, blocks_.handle, 0, 1, 0);
  ++device_.counters().draws;
}

Status LightShaftPass::drawShadows(VkCommandBuffer commands, const Tables& tables,
                                   const FrameState& draw, const HostImage& sceneDepth,
                                   const CasterSet& casters, VkDescriptorSet lut) {
  engine::Barriers barriers;
  for (uint32_t i = 0; i < targetCount_; ++i) barriers.discard(targets_[i], engine::kColorDrawn);
  Status status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;

  VkRenderingAttachmentInfo colors[2];
  for (uint32_t i = 0; i < targetCount_; ++i) {
    colors[i] =
        engine::structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
    colors[i].imageView = targets_[i].view;
    colors[i].imageLayout = engine::kColorDrawn.layout;
    colors[i].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colors[i].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    if (i == 1) colors[i].clearValue.color.float32[0] = -std::numeric_limits<float>::infinity();
  }
  auto depth =
      engine::structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
  depth.imageView = sceneDepth.view;
  depth.imageLayout = sceneDepth.layout;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  depth.storeOp = VK_ATTACHMENT_STORE_OP_NONE;
  auto rendering = engine::structure<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
  rendering.renderArea = draw.viewport;
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = targetCount_;
  rendering.pColorAttachments = colors;
  rendering.pDepthAttachment = &depth;

  const engine::Dispatch& vk = device_.vk();
  const VkDescriptorSet sets[] = {tables.descriptorSet(), set_, lut};
  vk.CmdBeginRendering(commands, &rendering);
  const bool lookUp = looksUp() && lut != VK_NULL_HANDLE;
  vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, lookUp ? 3 : 2,
                           sets, 0, nullptr);
  const VkPipeline pipeline = lookUp ? lutPipeline_ : pipeline_;
  if (exact()) {
    drawSurface(commands, draw, pipeline);
  } else {
    CasterTarget target;
    target.device = &device_;
    target.layout = layout_;
    target.eye = draw.camera.position_m;
    target.casters = &casters;
    double clip[16];
    passes::clipFromCamera(desc_.projection, desc_.depth, draw, clip);
    drawCasters(commands, target, desc_.method, draw.camera.position_m, clip, pipeline,
                draw.viewport, casters);
  }
  vk.CmdEndRendering(commands);
  for (uint32_t i = 0; i < targetCount_; ++i) barriers.image(targets_[i], engine::kFragmentSampled);
  return barriers.record(device_, commands);
}

}  // namespace alpenglow::passes
