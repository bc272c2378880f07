#include "landscape.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/scene_plan.h"

namespace alpenglow::samples {
namespace {

// Depth is reversed and infinitely far: floats have the same digits at any distance then, and the
// near plane can be as close as anyone's nose.
constexpr double kNear_m = 0.5;

/// Balloon of balloon.glsl.
struct BalloonPush {
  float centerRadius[4];
  float upright[4];
  float colorOpacity[4];
};

constexpr uint32_t kBalloonVertices = 6 * 48 * 32;  // kAround x kDown cells of balloon.vert.

float narrow(double value) { return static_cast<float>(value); }

FrameBlock frameBlock(const Parameters& parameters, Projection projection, const SkyDraw& draw) {
  FrameBlock block = {};
  clipFromCamera(projection, DepthConvention::Reversed, draw, block.clipFromCamera);
  const Camera& camera = draw.camera;
  const double r = std::hypot(camera.position_m[0], camera.position_m[1], camera.position_m[2]);
  const double scale = draw.radianceScale == 0.0 ? 1.0 : draw.radianceScale;
  for (uint32_t i = 0; i < 3; ++i) {
    block.upAltitude[i] = narrow(camera.position_m[i] / r);
    block.forwardParallel[i] = narrow(camera.forward[i]);
    block.sun[i] = narrow(draw.sun.direction[i]);
    block.irradiance[i] = narrow(draw.sun.irradiance[i] * scale);
  }
  block.upAltitude[3] = narrow(std::max(r - parameters.bottomRadius_m, 0.0));
  block.forwardParallel[3] = projection == Projection::Orthographic ? 1.0f : 0.0f;
  return block;
}

BalloonPush balloonPush(const Parameters& parameters, const io::SceneBalloon& balloon,
                        const Camera& camera) {
  const Camera at = cameraFromGeodetic(parameters, balloon.latitude, balloon.longitude,
                                       balloon.altitude_m, 0.0, 0.0, 0.0, 1.0);
  BalloonPush push = {};
  for (uint32_t i = 0; i < 3; ++i) {
    push.centerRadius[i] = narrow(at.position_m[i] - camera.position_m[i]);
    push.upright[i] = narrow(at.up[i]);
    push.colorOpacity[i] = narrow(balloon.color[i]);
  }
  push.centerRadius[3] = narrow(balloon.radius_m);
  push.colorOpacity[3] = narrow(balloon.opacity);
  return push;
}

VkRenderingAttachmentInfo attachmentOf(const headless::Image& image, VkImageLayout layout) {
  VkRenderingAttachmentInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  info.imageView = image.view();
  info.imageLayout = layout;
  info.loadOp = VK_ATTACHMENT_LOAD_OP_LOAD;
  info.storeOp = VK_ATTACHMENT_STORE_OP_NONE;  // Only read.
  return info;
}

}  // namespace

Landscape::Landscape(const Gpu* gpu, const io::Scene& scene, const TerrainMesh* mesh,
                     const io::AlbedoMap* albedo, const LandscapeDesc& desc)
    : gpu_(gpu),
      projection_(projectionOf(scene.camera)),
      parameters_(scene.atmosphere),
      balloons_(scene.balloons),
      mesh_(mesh) {
  if (mesh != nullptr) {
    depth_ =
        gpu->image(desc.size, kDepthFormat,
                   VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, 1);
    depthAttachment_ = attachmentOf(depth_, kDepthRead.layout);
    uploadTerrain(*scene.terrain, albedo);
    if (desc.shafts != nullptr) makeShafts(desc);
  }
  LandscapePipelinesDesc pipelines;
  pipelines.tables = desc.tables;
  pipelines.colorFormat = desc.colorFormat;
  pipelines.solver = desc.solver;
  pipelines.mie = desc.mie;
  pipelines.terrainAlbedo = mesh != nullptr ? &albedo_ : nullptr;
  pipelines.balloons = hasBalloons();
  pipelines.shafts = shafts_;
  pipelines_.emplace(gpu, pipelines);
}

Landscape::~Landscape() {
  if (shafts_ != nullptr) destroyShafts(shafts_);
}

void Landscape::uploadTerrain(const io::SceneTerrain& terrain, const io::AlbedoMap* albedo) {
  const auto filled = [&](const auto& array, VkBufferUsageFlags usage) {
    return gpu_->buffer(array.size() * sizeof array[0], usage, array.data());
  };
  uploadVertices();
  indices_ = filled(mesh_->indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  if (albedo != nullptr) {
    albedo_ = gpu_->texture(*albedo);
    return;
  }
  float rgba[4] = {0.0f, 0.0f, 0.0f, 1.0f};  // One texel, so that one shader serves both.
  for (uint32_t i = 0; i < kSpectrumSize; ++i) rgba[i] = static_cast<float>(terrain.albedo[i]);
  albedo_ = gpu_->texel(rgba);
}

void Landscape::uploadVertices() {
  vertices_ = gpu_->buffer(mesh_->vertices.size() * sizeof mesh_->vertices[0],
                           VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, mesh_->vertices.data());
}

void Landscape::makeShafts(const LandscapeDesc& desc) {
  ShaftsDesc full = *desc.shafts;
  full.closed = true;
  full.adjacency = full.method == ShaftMethod::Paper;
  if (full.adjacency) {
    const std::vector<uint32_t> indices = withAdjacency(*mesh_);
    adjacency_ = gpu_->buffer(indices.size() * sizeof(uint32_t), VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                              indices.data());
    adjacencyCount_ = indices.size();
  }
  full.sceneDepth = {depth_.view(), kDepthFormat, desc.size, kDepthRead.layout};
  full.depth = DepthConvention::Reversed;
  full.projection = projection_;
  full.vertexStride = sizeof(TerrainVertex);
  full.vertexOffset = offsetof(TerrainVertex, position);
  gpu_->check(createShafts(desc.context, full, &shafts_));
}

void Landscape::describe(ViewDesc* view) const {
  if (mesh_ == nullptr) return;
  view->sceneDepth = {depth_.view(), kDepthFormat, depth_.extent(), kDepthRead.layout};
  view->depthFormat = kDepthFormat;
  view->depth = DepthConvention::Reversed;
  view->shafts = shafts_;
}

DepthRange Landscape::depthRange(const Camera& camera) const {
  if (projection_ != Projection::Orthographic) return {kNear_m, 0.0};
  // Parallel rays need a far plane: behind all that is drawn.
  double most = 1.0;
  if (mesh_ != nullptr) {
    most = std::max(most, reachOf(mesh_->place.box, camera.position_m, camera.forward).most * 1.01);
  }
  for (const io::SceneBalloon& balloon : balloons_) {
    const Camera at = cameraFromGeodetic(parameters_, balloon.latitude, balloon.longitude,
                                         balloon.altitude_m, 0.0, 0.0, 0.0, 1.0);
    double along = 2.0 * balloon.radius_m;
    for (int i = 0; i < 3; ++i)
      along += (at.position_m[i] - camera.position_m[i]) * camera.forward[i];
    most = std::max(most, along);
  }
  return {0.0, most};
}

Casters Landscape::casters() {
  Casters casters;
  casters.bounds = mesh_->place.box;
  casters.user = this;
  casters.draw = [](void* user, VkCommandBuffer commands, const CasterPass* pass) {
    const auto* self = static_cast<const Landscape*>(user);
    placeCaster(pass, self->mesh_->place.origin_m, nullptr);
    if (self->adjacencyCount_ > 0)
      self->drawTerrain(commands, self->adjacency_, self->adjacencyCount_);
    else
      self->drawTerrain(commands, self->indices_, self->mesh_->indices.size());
  };
  return casters;
}

void Landscape::drawTerrain(VkCommandBuffer commands, const headless::HostBuffer& indices,
                            size_t count) const {
  const VkBuffer vertices = vertices_.buffer();
  const VkDeviceSize offset = 0;
  gpu_->function<PFN_vkCmdBindVertexBuffers>("vkCmdBindVertexBuffers")(commands, 0, 1, &vertices,
                                                                       &offset);
  gpu_->function<PFN_vkCmdBindIndexBuffer>("vkCmdBindIndexBuffer")(commands, indices.buffer(), 0,
                                                                   VK_INDEX_TYPE_UINT32);
  gpu_->function<PFN_vkCmdDrawIndexed>("vkCmdDrawIndexed")(commands, static_cast<uint32_t>(count),
                                                           1, 0, 0, 0);
}

const VkRenderingAttachmentInfo* Landscape::depthAttachment() const {
  return mesh_ != nullptr ? &depthAttachment_ : nullptr;
}

void Landscape::recordFrame(VkCommandBuffer commands, const SkyDraw& draw) const {
  const FrameBlock block = frameBlock(parameters_, projection_, draw);
  constexpr VkPipelineStageFlags2 kReaders =
      VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  const ImageState read = {VK_IMAGE_LAYOUT_UNDEFINED, kReaders, VK_ACCESS_2_UNIFORM_READ_BIT};
  const ImageState written = {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                              VK_ACCESS_2_TRANSFER_WRITE_BIT};
  gpu_->barrier(commands, read, written);  // The last frame may still read it.
  gpu_->function<PFN_vkCmdUpdateBuffer>("vkCmdUpdateBuffer")(commands, pipelines_->frame().buffer(),
                                                             0, sizeof block, &block);
  gpu_->barrier(commands, written, read);
}

void Landscape::setPicture(VkCommandBuffer commands, const SkyDraw& draw) const {
  const VkRect2D& area = draw.viewport;
  const VkViewport viewport = {static_cast<float>(area.offset.x),
                               static_cast<float>(area.offset.y),
                               static_cast<float>(area.extent.width),
                               static_cast<float>(area.extent.height),
                               0.0f,
                               1.0f};
  gpu_->function<PFN_vkCmdSetViewport>("vkCmdSetViewport")(commands, 0, 1, &viewport);
  gpu_->function<PFN_vkCmdSetScissor>("vkCmdSetScissor")(commands, 0, 1, &area);
}

void Landscape::placeTerrain(VkCommandBuffer commands, const SkyDraw& draw) const {
  float offset[4] = {};
  for (int i = 0; i < 3; ++i) {
    offset[i] = narrow(mesh_->place.origin_m[i] - draw.camera.position_m[i]);
  }
  pipelines_->push(commands, offset, sizeof offset);
}

void Landscape::recordDepth(VkCommandBuffer commands, const SkyDraw& draw) const {
  gpu_->barrier(commands, depth_, {kUndefined.layout, kDepthRead.stage, VK_ACCESS_2_NONE},
                kDepthDrawn);
  VkRenderingAttachmentInfo attachment = depthAttachment_;
  attachment.imageLayout = kDepthDrawn.layout;
  attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;  // To 0, infinitely far.
  attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo rendering = {};
  rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  rendering.renderArea = draw.viewport;
  rendering.layerCount = 1;
  rendering.pDepthAttachment = &attachment;
  gpu_->function<PFN_vkCmdBeginRendering>("vkCmdBeginRendering")(commands, &rendering);
  setPicture(commands, draw);
  pipelines_->bindDepth(commands);
  placeTerrain(commands, draw);
  drawTerrain(commands, indices_, mesh_->indices.size());
  gpu_->function<PFN_vkCmdEndRendering>("vkCmdEndRendering")(commands);
  gpu_->barrier(commands, depth_, kDepthDrawn, kDepthRead);
}

void Landscape::recordTerrain(VkCommandBuffer commands, const Tables* tables,
                              const SkyDraw& draw) const {
  setPicture(commands, draw);
  pipelines_->bindTerrain(commands, tables);
  placeTerrain(commands, draw);
  drawTerrain(commands, indices_, mesh_->indices.size());
}

void Landscape::recordBalloons(VkCommandBuffer commands, const Tables* tables,
                               const SkyDraw& draw) const {
  std::vector<BalloonPush> pushes;
  for (const io::SceneBalloon& balloon : balloons_) {
    pushes.push_back(balloonPush(parameters_, balloon, draw.camera));
  }
  const auto distance = [&](const BalloonPush& push) {
    const float* c = push.centerRadius;
    if (projection_ != Projection::Orthographic) return std::hypot(c[0], c[1], c[2]);
    const double* f = draw.camera.forward;
    return narrow(c[0] * f[0] + c[1] * f[1] + c[2] * f[2]);
  };
  std::sort(pushes.begin(), pushes.end(), [&](const BalloonPush& a, const BalloonPush& b) {
    return distance(a) > distance(b);  // What is blended first lies behind.
  });
  setPicture(commands, draw);
  pipelines_->bindBalloons(commands, tables);
  for (const BalloonPush& push : pushes) {
    pipelines_->push(commands, &push, sizeof push);
    gpu_->function<PFN_vkCmdDraw>("vkCmdDraw")(commands, kBalloonVertices, 1, 0, 0);
  }
}

}  // namespace alpenglow::samples
