#include "atmosphere/shafts/shaft_pass.h"

#include <alpenglow/shaders/shaft_caster.h>
#include <alpenglow/shaders/shaft_cull.h>
#include <alpenglow/shaders/shaft_surface.h>
#include <alpenglow/shaders/shaft_volume_fragment.h>
#include <alpenglow/shaders/shaft_volume_geometry.h>

#include <algorithm>
#include <limits>
#include <new>

#include "atmosphere/bake/effect_constants.h"
#include "atmosphere/sky/air_set.h"
#include "atmosphere/sky/shader_choice.h"
#include "engine/barriers.h"
#include "engine/structure.h"

namespace alpenglow {
inline namespace v1 {
namespace {

constexpr ImageState kBlended = {
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};

constexpr VkShaderStageFlags kCompute = VK_SHADER_STAGE_COMPUTE_BIT;
constexpr VkShaderStageFlags kMapStages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
constexpr VkDescriptorSetLayoutBinding sampled(uint32_t binding, VkShaderStageFlags stages) {
  return {binding, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, stages, nullptr};
}
constexpr uint32_t kBindingCount = 5;

/// Bytes before the list of AlpenglowShaftBlocks.
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

Status Shafts::create(bake::Resources& resources, const ShaftsDesc& desc, Shafts** out) {
  *out = nullptr;
  auto* shafts = new (std::nothrow) Shafts(resources, desc);
  if (shafts == nullptr) {
    return resources.device().fail(Status::OutOfHostMemory, VK_SUCCESS,
                                   "Light shafts found no host memory.");
  }
  ++resources.live().views;
  const Status status = shafts->make();
  if (status != Status::Ok) {
    destroy(shafts, 0);  // Nothing was recorded with it: frame 0 has always completed.
    return status;
  }
  *out = shafts;
  return Status::Ok;
}

void Shafts::destroy(Shafts* shafts, uint64_t frame) {
  if (shafts == nullptr) return;
  --shafts->resources_.live().views;
  engine::Device& device = shafts->device_;
  engine::DeletionQueue& deletions = device.deletions();
  const auto defer = [&](VkObjectType type, auto handle) {
    deletions.defer(frame, type, engine::handleNumber(handle));
  };
  defer(VK_OBJECT_TYPE_PIPELINE, shafts->pipeline_);
  defer(VK_OBJECT_TYPE_PIPELINE, shafts->volumePipeline_);
  defer(VK_OBJECT_TYPE_PIPELINE, shafts->cullPipeline_);
  defer(VK_OBJECT_TYPE_PIPELINE_LAYOUT, shafts->layout_);
  defer(VK_OBJECT_TYPE_PIPELINE_LAYOUT, shafts->cullLayout_);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_POOL, shafts->pool_);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, shafts->setLayout_);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, shafts->airLayout_);
  for (engine::Image& image : shafts->targets_)
    engine::deferImage(device, frame, &image);
  engine::deferBuffer(device, frame, &shafts->frame_);
  engine::deferBuffer(device, frame, &shafts->blocks_);
  engine::deferBlock(device, frame, &shafts->memory_);
  shafts->map_.destroy(frame);
  delete shafts;
  deletions.collect(device.completed());
}

Status Shafts::make() {
  Status status = mapped() ? map_.make(desc_) : Status::Ok;
  if (status == Status::Ok) status = makeTargets();
  if (status == Status::Ok) status = makeSet();
  if (status == Status::Ok && desc_.method != ShaftMethod::March) status = makePipelines();
  if (status == Status::Ok && exact()) status = makeCulling();
  return status;
}

Status Shafts::makeTargets() {
  Status status =
      engine::createBuffer(device_, sizeof(shafts::ShaftFrame),
                           VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                               VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                           "Alpenglow shaft frame", &frame_);
  if (status != Status::Ok) return status;
  const uint32_t side = shafts::blocksAcross(desc_);
  if (exact()) {
    status = engine::createBuffer(device_, kBlocksHead + VkDeviceSize{4} * side * side,
                                  VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                      VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                  "Alpenglow shaft blocks", &blocks_);
    if (status != Status::Ok) return status;
  }
  const bool paper = desc_.method == ShaftMethod::Paper;
  const uint32_t count = paper ? 2 : exact() ? 1 : 0;
  engine::Image* images[] = {&targets_[0], &targets_[1]};
  for (uint32_t i = 0; i < count; ++i) {
    engine::ImageDesc image;
    image.format = paper ? VK_FORMAT_R32G32_SFLOAT : sumFormat(device_);
    image.extent = {desc_.sceneDepth.extent.width, desc_.sceneDepth.extent.height, 1};
    image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                  VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    image.linearFilter = false;
    image.name = i == 0 ? "Alpenglow shaft sums" : "Alpenglow shaft bounds";
    status = engine::createImage(device_, image, &targets_[i]);
    if (status != Status::Ok) return status;
    ++targetCount_;
  }
  engine::Buffer* buffers[] = {&frame_, &blocks_};
  return engine::allocateAndBind(device_, "Alpenglow shafts", VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                                 images, targetCount_, buffers, exact() ? 2 : 1, &memory_);
}

Status Shafts::makeSet() {
  const VkShaderStageFlags geometry =
      desc_.method == ShaftMethod::Paper ? VK_SHADER_STAGE_GEOMETRY_BIT : 0;
  // AlpenglowShaftFrame, the map from the sun, sums, bounds, blocks.
  const VkDescriptorSetLayoutBinding bindings[kBindingCount] = {
      {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, kMapStages | geometry | kCompute, nullptr},
      sampled(1, kMapStages | geometry | kCompute),
      sampled(2, VK_SHADER_STAGE_FRAGMENT_BIT),
      sampled(3, VK_SHADER_STAGE_FRAGMENT_BIT),
      {4, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, kMapStages | kCompute, nullptr}};
  Status status =
      engine::createSetLayout(device_, bindings, kBindingCount, "Alpenglow shafts", &setLayout_);
  if (status != Status::Ok) return status;
  const engine::PoolPart part = {bindings, kBindingCount, 1};
  status = engine::createPool(device_, &part, 1, "Alpenglow shafts", &pool_);
  if (status != Status::Ok) return status;
  status = engine::allocateSets(device_, pool_, &setLayout_, 1, "Alpenglow shafts", &set_);
  if (status != Status::Ok) return status;
  // A shader that asks for any method reads all of them: what a method lacks is another image.
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

Status Shafts::makePipelines() {
  Status status = sky::createAirSetLayout(device_, &airLayout_);
  if (status != Status::Ok) return status;
  const VkDescriptorSetLayout sets[] = {resources_.tableLayout(), setLayout_, airLayout_};
  status = engine::createPipelineLayout(device_, sets, 3, &shafts::kPlaceRange, 1,
                                        "Alpenglow shafts", &layout_);
  if (status == Status::Ok) status = makePipeline(false, &pipeline_);
  if (status == Status::Ok && looksUp()) status = makePipeline(true, &volumePipeline_);
  return status;
}

Status Shafts::makeCulling() {
  namespace s = alpenglow::shaders;
  const Status status = engine::createPipelineLayout(device_, &setLayout_, 1, nullptr, 0,
                                                     "Alpenglow shaft blocks", &cullLayout_);
  if (status != Status::Ok) return status;
  engine::ComputePipelineDesc desc;
  desc.shader = {s::kShaftCull, sizeof s::kShaftCull, "cull.comp"};
  desc.layout = cullLayout_;
  return engine::createComputePipeline(device_, desc, &cullPipeline_);
}

Status Shafts::makePipeline(bool fromVolume, VkPipeline* out) {
  namespace s = alpenglow::shaders;
  const bool reversed = desc_.depth == DepthConvention::Reversed;
  engine::GraphicsPipelineDesc desc;
  desc.colors[0] = {targets_[0].desc.format, engine::Blend::Add};
  if (exact()) {
    desc.vertex = {s::kShaftSurface, sizeof s::kShaftSurface, "surface.vert"};
    desc.fragment = sky::surfaceShader(desc_.without, fromVolume);
    desc.topology = engine::Topology::TriangleStrip;
  } else {
    desc.vertex = {s::kShaftCaster, sizeof s::kShaftCaster, "caster.vert"};
    desc.geometry = {s::kShaftVolumeGeometry, sizeof s::kShaftVolumeGeometry, "volume.geom"};
    desc.fragment = {s::kShaftVolumeFragment, sizeof s::kShaftVolumeFragment, "volume.frag"};
    desc.colors[1] = {targets_[1].desc.format, engine::Blend::Max};
    desc.vertices = {desc_.vertexStride, desc_.vertexOffset};
    desc.topology = engine::Topology::TrianglesWithAdjacency;
  }
  engine::SpecConstant constants[2 + bake::kEffectConstants] = {
      engine::specBool(6, desc_.projection == Projection::Orthographic),
      engine::specBool(7, reversed)};
  std::ranges::copy(bake::effectConstants(desc_.without), constants + 2);
  desc.constants = constants;
  desc.constantCount = 2 + bake::kEffectConstants;
  desc.layout = layout_;
  desc.depthFormat = desc_.sceneDepth.format;
  desc.stencil = false;
  desc.depthTest = true;
  desc.depthClamp = true;  // what lies beyond the far plane shadows the sky
  desc.depthCompare = reversed ? VK_COMPARE_OP_GREATER_OR_EQUAL : VK_COMPARE_OP_LESS_OR_EQUAL;
  return engine::createGraphicsPipeline(device_, desc, out);
}

Status Shafts::recordSunMap(VkCommandBuffer commands, const double sun[3], const Casters& casters) {
  if (!mapped()) return Status::Ok;
  return map_.record(commands, sun, casters);
}

Status Shafts::checkMap(const SkyDraw& draw) const {
  if (!mapped() || std::equal(map_.sun(), map_.sun() + 3, draw.sun.direction)) return Status::Ok;
  return device_.fail(Status::InvalidArgument, VK_SUCCESS,
                      "recordShafts got the sun at (%g, %g, %g), but recordSunMap was called last "
                      "for (%g, %g, %g): they must be the same.",
                      draw.sun.direction[0], draw.sun.direction[1], draw.sun.direction[2],
                      map_.sun()[0], map_.sun()[1], map_.sun()[2]);
}

Status Shafts::record(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw,
                      const Casters& casters, VkDescriptorSet air) {
  Status status = checkMap(draw);
  if (status != Status::Ok) return status;
  status =
      updateFrame(commands, shafts::makeShaftFrame(tables.parameters(), desc_, map_.place(), draw));
  if (status == Status::Ok && exact()) status = cullBlocks(commands);
  if (status == Status::Ok && targetCount_ > 0)
    status = drawShadows(commands, tables, draw, casters, air);
  if (status != Status::Ok) return status;
  tablesId_ = tables.id();
  draw_ = draw;
  return Status::Ok;
}

Status Shafts::updateFrame(VkCommandBuffer commands, const shafts::ShaftFrame& frame) {
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
                  VK_ACCESS_2_UNIFORM_READ_BIT);
  return barriers.record(device_, commands);
}

Status Shafts::cullBlocks(VkCommandBuffer commands) {
  const engine::Dispatch& vk = device_.vk();
  const uint32_t side = shafts::blocksAcross(desc_);
  const uint32_t strip = 2 * shafts::kShaftBlock + 4;
  const VkDrawIndirectCommand none = {strip * shafts::kShaftBlock, 0, 0, 0};
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

void Shafts::drawSurface(VkCommandBuffer commands, const SkyDraw& draw, VkPipeline pipeline) {
  const engine::Dispatch& vk = device_.vk();
  engine::setArea(device_, commands, draw.viewport);
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  vk.CmdDrawIndirect(commands, blocks_.handle, 0, 1, 0);
  ++device_.counters().draws;
}

Status Shafts::drawShadows(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw,
                           const Casters& casters, VkDescriptorSet air) {
  engine::Barriers barriers;
  for (uint32_t i = 0; i < targetCount_; ++i) barriers.discard(targets_[i], kBlended);
  Status status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;

  VkRenderingAttachmentInfo colors[2];
  for (uint32_t i = 0; i < targetCount_; ++i) {
    colors[i] =
        engine::structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
    colors[i].imageView = targets_[i].view;
    colors[i].imageLayout = kBlended.layout;
    colors[i].loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colors[i].storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    if (i == 1) colors[i].clearValue.color.float32[0] = -std::numeric_limits<float>::infinity();
  }
  auto depth =
      engine::structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
  depth.imageView = desc_.sceneDepth.view;
  depth.imageLayout = desc_.sceneDepth.layout;
  depth.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  depth.storeOp = VK_ATTACHMENT_STORE_OP_NONE;
  auto rendering = engine::structure<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
  rendering.renderArea = draw.viewport;
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = targetCount_;
  rendering.pColorAttachments = colors;
  rendering.pDepthAttachment = &depth;

  const engine::Dispatch& vk = device_.vk();
  const VkDescriptorSet sets[] = {tables.descriptorSet(), set_, air};
  vk.CmdBeginRendering(commands, &rendering);
  const bool lookUp = looksUp() && air != VK_NULL_HANDLE;
  vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, lookUp ? 3 : 2,
                           sets, 0, nullptr);
  const VkPipeline pipeline = lookUp ? volumePipeline_ : pipeline_;
  if (exact()) {
    drawSurface(commands, draw, pipeline);
  } else {
    CasterPass pass;
    pass.device = &device_;
    pass.commands = commands;
    pass.layout = layout_;
    pass.eye = draw.camera.position_m;
    shafts::drawCasters(pass, pipeline, draw.viewport, casters);
  }
  vk.CmdEndRendering(commands);
  for (uint32_t i = 0; i < targetCount_; ++i) barriers.image(targets_[i], engine::kFragmentSampled);
  return barriers.record(device_, commands);
}

bool Shafts::serves(const Tables& tables, const SkyDraw& draw) const {
  const auto same = [](const double a[3], const double b[3]) { return std::equal(a, a + 3, b); };
  const Camera &a = draw_.camera, &b = draw.camera;
  const VkRect2D &p = draw_.viewport, &q = draw.viewport;
  return tablesId_ == tables.id() && same(a.position_m, b.position_m) &&
         same(a.forward, b.forward) && same(a.up, b.up) && a.fov == b.fov &&
         a.height_m == b.height_m && draw_.depth.near_m == draw.depth.near_m &&
         draw_.depth.far_m == draw.depth.far_m && same(draw_.sun.direction, draw.sun.direction) &&
         p.offset.x == q.offset.x && p.offset.y == q.offset.y && p.extent.width == q.extent.width &&
         p.extent.height == q.extent.height;
}

}  // namespace v1
}  // namespace alpenglow
