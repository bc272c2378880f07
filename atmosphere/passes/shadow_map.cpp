#include "atmosphere/passes/shadow_map.h"

#include <alpenglow/shaders/shadow_map.h>

#include <cmath>

#include "engine/barriers.h"
#include "engine/pipeline.h"
#include "engine/structure.h"

namespace alpenglow::passes {
namespace {

constexpr engine::ImageState kDepthDrawn = {VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                                            engine::kDepthDrawn.stage, engine::kDepthDrawn.access};
constexpr engine::ImageState kRead = {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                      VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT |
                                          VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                                          VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                      VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

}  // namespace

Status ShadowMap::make(const LightShaftSettings& desc) {
  size_ = desc.shadowMapSize;
  method_ = desc.method;
  const Status status = makeImage();
  return status == Status::Ok ? makePipeline(desc) : status;
}

Status ShadowMap::makeImage() {
  engine::ImageDesc desc;
  desc.format = kShadowMapFormat;
  desc.extent = {size_, size_, 1};
  desc.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  desc.linearFilter = false;
  desc.name = "Alpenglow shadow map";
  const Status status = engine::createImage(device_, desc, &depth_);
  if (status != Status::Ok) return status;
  engine::Image* images[] = {&depth_};
  return engine::allocateAndBind(device_, "Alpenglow shadow map",
                                 VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, images, 1, nullptr, 0,
                                 &memory_);
}

Status ShadowMap::makePipeline(const LightShaftSettings& desc) {
  namespace s = alpenglow::shaders;
  const Status status = engine::createPipelineLayout(device_, nullptr, 0, &kPlaceRange, 1,
                                                     "Alpenglow shadow map", &layout_);
  if (status != Status::Ok) return status;
  engine::GraphicsPipelineDesc draw;
  draw.vertex = {s::kShadowMap, sizeof s::kShadowMap, "shadow_map.vert"};
  draw.layout = layout_;
  draw.vertices = {desc.vertexStride, desc.vertexOffset};
  draw.topology =
      desc.adjacency ? engine::Topology::TrianglesWithAdjacency : engine::Topology::Triangles;
  draw.depthFormat = kShadowMapFormat;
  draw.depthTest = draw.depthWrite = true;
  draw.depthClamp = true;
  draw.depthCompare = VK_COMPARE_OP_LESS;
  // The map's rows run down the picture where its axes form a right-handed frame with the sun: what
  // faces the sun runs clockwise.
  if (desc.closed) draw.cull = VK_CULL_MODE_FRONT_BIT;
  return engine::createGraphicsPipeline(device_, draw, &pipeline_);
}

void ShadowMap::destroy(uint64_t frame) {
  engine::DeletionQueue& deletions = device_.deletions();
  deletions.defer(frame, VK_OBJECT_TYPE_PIPELINE, engine::handleNumber(pipeline_));
  deletions.defer(frame, VK_OBJECT_TYPE_PIPELINE_LAYOUT, engine::handleNumber(layout_));
  engine::deferImage(device_, frame, &depth_);
  engine::deferBlock(device_, frame, &memory_);
}

namespace {

bool same(const double a[3], const double b[3], double tolerance) {
  return std::abs(a[0] - b[0]) <= tolerance && std::abs(a[1] - b[1]) <= tolerance &&
         std::abs(a[2] - b[2]) <= tolerance;
}

}  // namespace

// A direction that differs by rounding alone is the same.
bool ShadowMap::drawnFor(const double sun[3]) const {
  constexpr double kSameDirection = 1e-7;
  return recorded_ && same(place_.sun, sun, kSameDirection);
}

bool ShadowMap::current(const double sun[3], const CasterSet& casters) const {
  if (!drawnFor(sun) || casters.version == 0 || casters.version != version_) return false;
  constexpr double kSamePlace_m = 1e-3;
  bool still = same(bounds_.center_m, casters.bounds.center_m, kSamePlace_m);
  for (int i = 0; i < 3; ++i)
    still = still && same(bounds_.halfAxes_m[i], casters.bounds.halfAxes_m[i], kSamePlace_m);
  return still;
}

Status ShadowMap::recordReadable(VkCommandBuffer commands) {
  if (recorded_) return Status::Ok;
  engine::Barriers barriers;
  barriers.discard(depth_, kRead);
  return barriers.record(device_, commands);
}

Status ShadowMap::record(VkCommandBuffer commands, const double sun[3], const CasterSet& casters) {
  recorded_ = false;
  place_ = placeShadowMap(casters.bounds, sun, size_);
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
  CasterTarget target;
  target.device = &device_;
  target.layout = layout_;
  target.map = &place_;
  target.casters = &casters;
  double clip[16];
  clipFromMap(place_, clip);
  drawCasters(commands, target, method_, place_.center, clip, pipeline_, rendering.renderArea,
              casters);
  vk.CmdEndRendering(commands);
  barriers.image(depth_, kRead);
  status = barriers.record(device_, commands);
  if (status != Status::Ok) return status;
  recorded_ = true;
  frame_ = device_.submitting();
  version_ = casters.version;
  bounds_ = casters.bounds;
  return Status::Ok;
}

}  // namespace alpenglow::passes
