#include "atmosphere/shafts/sun_map.h"

#include <alpenglow/shaders/sun_blocks.h>
#include <alpenglow/shaders/sun_blocks_around.h>
#include <alpenglow/shaders/sun_map.h>

#include "engine/barriers.h"
#include "engine/structure.h"

namespace alpenglow::shafts {
namespace {

constexpr ImageState kDepthDrawn = {
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
/// By the blocks' dispatch, by geometry and by fragment shaders.
constexpr ImageState kReadByAll = {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
                                       VK_PIPELINE_STAGE_2_GEOMETRY_SHADER_BIT |
                                       VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                   VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

constexpr VkDescriptorSetLayoutBinding kBindings[2] = {
    {0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
    {1, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};

}  // namespace

Status SunMap::make(const ShaftsDesc& desc, bool blocks) {
  size_ = desc.sunMapSize;
  hasBlocks_ = blocks;
  Status status = makeImages();
  if (status == Status::Ok && hasBlocks_) status = makeSets();
  if (status == Status::Ok) status = makePipelines(desc);
  return status;
}

Status SunMap::makeImages() {
  engine::ImageDesc desc;
  desc.format = kSunMapFormat;
  desc.extent = {size_, size_, 1};
  desc.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  desc.linearFilter = false;
  desc.name = "Alpenglow map from the sun";
  Status status = engine::createImage(device_, desc, &depth_);
  if (status != Status::Ok) return status;
  engine::Image* images[] = {&depth_, &blocks_[0], &blocks_[1]};
  const uint32_t side = (size_ + kSunMapBlock - 1) / kSunMapBlock;
  for (int i = 0; hasBlocks_ && i < 2; ++i) {
    desc.format = VK_FORMAT_R32_SFLOAT;
    desc.extent = {side, side, 1};
    desc.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    desc.name = i == 0 ? "Alpenglow sun blocks" : "Alpenglow sun blocks around";
    status = engine::createImage(device_, desc, &blocks_[i]);
    if (status != Status::Ok) return status;
  }
  return engine::allocateAndBind(device_, "Alpenglow map from the sun",
                                 VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, images, hasBlocks_ ? 3 : 1,
                                 nullptr, 0, &memory_);
}

Status SunMap::makeSets() {
  Status status =
      engine::createSetLayout(device_, kBindings, 2, "Alpenglow sun blocks", &setLayout_);
  if (status != Status::Ok) return status;
  const engine::PoolPart part = {kBindings, 2, 2};
  status = engine::createPool(device_, &part, 1, "Alpenglow sun blocks", &pool_);
  if (status != Status::Ok) return status;
  const VkDescriptorSetLayout layouts[2] = {setLayout_, setLayout_};
  status = engine::allocateSets(device_, pool_, layouts, 2, "Alpenglow sun blocks", sets_);
  const engine::Image* read[2] = {&depth_, &blocks_[0]};
  for (int i = 0; status == Status::Ok && i < 2; ++i) {
    engine::DescriptorWriter writer(sets_[i]);
    writer.sampledImage(0, read[i]->view, resources_.nearestSampler())
        .storageImage(1, blocks_[i].view);
    status = writer.flush(device_);
  }
  return status;
}

Status SunMap::makePipelines(const ShaftsDesc& desc) {
  namespace s = alpenglow::shaders;
  Status status = engine::createPipelineLayout(device_, nullptr, 0, &kPlaceRange, 1,
                                               "Alpenglow map from the sun", &drawLayout_);
  if (status != Status::Ok) return status;
  engine::GraphicsPipelineDesc draw;
  draw.vertex = {s::kSunMap, sizeof s::kSunMap, "sun_map.vert"};
  draw.layout = drawLayout_;
  draw.vertices = {desc.vertexStride, desc.vertexOffset};
  draw.adjacency = true;
  draw.depthFormat = kSunMapFormat;
  draw.depthTest = draw.depthWrite = true;
  draw.depthClamp = true;
  draw.depthCompare = VK_COMPARE_OP_LESS;
  status = engine::createGraphicsPipeline(device_, draw, &drawPipeline_);
  if (status != Status::Ok || !hasBlocks_) return status;
  status = engine::createPipelineLayout(device_, &setLayout_, 1, nullptr, 0, "Alpenglow sun blocks",
                                        &blocksLayout_);
  const engine::Shader shaders[2] = {
      {s::kSunBlocks, sizeof s::kSunBlocks, "sun_blocks"},
      {s::kSunBlocksAround, sizeof s::kSunBlocksAround, "sun_blocks (around)"}};
  for (int i = 0; status == Status::Ok && i < 2; ++i) {
    engine::ComputePipelineDesc compute;
    compute.shader = shaders[i];
    compute.layout = blocksLayout_;
    status = engine::createComputePipeline(device_, compute, &blocksPipelines_[i]);
  }
  return status;
}

void SunMap::destroy(const FrameInfo& frame) {
  engine::DeletionQueue& deletions = device_.deletions();
  const auto defer = [&](VkObjectType type, auto handle) {
    deletions.defer(frame.submitting, type, engine::handleNumber(handle));
  };
  for (VkPipeline pipeline : {drawPipeline_, blocksPipelines_[0], blocksPipelines_[1]})
    defer(VK_OBJECT_TYPE_PIPELINE, pipeline);
  defer(VK_OBJECT_TYPE_PIPELINE_LAYOUT, drawLayout_);
  defer(VK_OBJECT_TYPE_PIPELINE_LAYOUT, blocksLayout_);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool_);
  defer(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, setLayout_);
  for (engine::Image* image : {&depth_, &blocks_[0], &blocks_[1]})
    engine::deferImage(device_, frame.submitting, image);
  engine::deferBlock(device_, frame.submitting, &memory_);
}

Status SunMap::record(VkCommandBuffer commands, const double sun[3], const Casters& casters) {
  place_ = placeSunMap(casters.bounds, sun, size_);
  engine::Barriers barriers;
  barriers.discard(depth_, kDepthDrawn);
  Status status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;

  auto attachment =
      engine::structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
  attachment.imageView = depth_.view;
  attachment.imageLayout = kDepthDrawn.layout;
  attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  attachment.clearValue.depthStencil = {1.0f, 0};
  auto rendering = engine::structure<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
  rendering.renderArea = {{0, 0}, {size_, size_}};
  rendering.layerCount = 1;
  rendering.pDepthAttachment = &attachment;
  const engine::Dispatch& vk = device_.vk();
  vk.CmdBeginRendering(commands, &rendering);
  CasterPass pass;
  pass.device = &device_;
  pass.commands = commands;
  pass.layout = drawLayout_;
  pass.map = &place_;
  drawCasters(pass, drawPipeline_, rendering.renderArea, casters);
  vk.CmdEndRendering(commands);
  if (hasBlocks_) return recordBlocks(commands);
  barriers.image(depth_, kReadByAll);
  return barriers.record(device_, commands);
}

Status SunMap::recordBlocks(VkCommandBuffer commands) {
  const engine::Dispatch& vk = device_.vk();
  const uint32_t side = blocks_[0].desc.extent.width;
  const VkExtent3D groups = {(side + 7) / 8, (side + 7) / 8, 1};
  engine::Barriers barriers;
  barriers.image(depth_, kReadByAll);
  for (int i = 0; i < 2; ++i) {
    barriers.discard(blocks_[i], engine::kComputeWrite);
    const Status status = barriers.record(device_, commands);
    if (status != Status::Ok) return status;
    vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, blocksPipelines_[i]);
    vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, blocksLayout_, 0, 1,
                             &sets_[i], 0, nullptr);
    vk.CmdDispatch(commands, groups.width, groups.height, 1);
    ++device_.counters().dispatches;
    barriers.image(blocks_[i], kReadByAll);
  }
  return barriers.record(device_, commands);
}

}  // namespace alpenglow::shafts
