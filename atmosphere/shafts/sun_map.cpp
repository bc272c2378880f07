#include "atmosphere/shafts/sun_map.h"

#include <alpenglow/shaders/sun_map.h>

#include "engine/barriers.h"
#include "engine/structure.h"

namespace alpenglow::shafts {
namespace {

constexpr ImageState kDepthDrawn = {
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
constexpr ImageState kRead = {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                              VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
                                  VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                                  VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                              VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

}  // namespace

Status SunMap::make(const ShaftsDesc& desc) {
  size_ = desc.sunMapSize;
  const Status status = makeImage();
  return status == Status::Ok ? makePipeline(desc) : status;
}

Status SunMap::makeImage() {
  engine::ImageDesc desc;
  desc.format = kSunMapFormat;
  desc.extent = {size_, size_, 1};
  desc.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  desc.linearFilter = false;
  desc.name = "Alpenglow map from the sun";
  const Status status = engine::createImage(device_, desc, &depth_);
  if (status != Status::Ok) return status;
  engine::Image* images[] = {&depth_};
  return engine::allocateAndBind(device_, "Alpenglow map from the sun",
                                 VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, images, 1, nullptr, 0,
                                 &memory_);
}

Status SunMap::makePipeline(const ShaftsDesc& desc) {
  namespace s = alpenglow::shaders;
  const Status status = engine::createPipelineLayout(device_, nullptr, 0, &kPlaceRange, 1,
                                                     "Alpenglow map from the sun", &layout_);
  if (status != Status::Ok) return status;
  engine::GraphicsPipelineDesc draw;
  draw.vertex = {s::kSunMap, sizeof s::kSunMap, "sun_map.vert"};
  draw.layout = layout_;
  draw.vertices = {desc.vertexStride, desc.vertexOffset};
  draw.topology =
      desc.adjacency ? engine::Topology::TrianglesWithAdjacency : engine::Topology::Triangles;
  draw.depthFormat = kSunMapFormat;
  draw.depthTest = draw.depthWrite = true;
  draw.depthClamp = true;
  draw.depthCompare = VK_COMPARE_OP_LESS;
  // The map's rows run down the picture where its axes form a right-handed frame with the sun: what
  // faces the sun runs clockwise.
  if (desc.closed) draw.cull = VK_CULL_MODE_FRONT_BIT;
  return engine::createGraphicsPipeline(device_, draw, &pipeline_);
}

void SunMap::destroy(uint64_t frame) {
  engine::DeletionQueue& deletions = device_.deletions();
  deletions.defer(frame, VK_OBJECT_TYPE_PIPELINE, engine::handleNumber(pipeline_));
  deletions.defer(frame, VK_OBJECT_TYPE_PIPELINE_LAYOUT, engine::handleNumber(layout_));
  engine::deferImage(device_, frame, &depth_);
  engine::deferBlock(device_, frame, &memory_);
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
  pass.layout = layout_;
  pass.map = &place_;
  drawCasters(pass, pipeline_, rendering.renderArea, casters);
  vk.CmdEndRendering(commands);
  barriers.image(depth_, kRead);
  return barriers.record(device_, commands);
}

}  // namespace alpenglow::shafts
