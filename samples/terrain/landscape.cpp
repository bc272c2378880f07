#include "landscape.h"

#include <alpenglow/mesh/terrain.h>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/scene_plan.h"

namespace alpenglow::samples {
namespace {

// Depth is reversed, with an infinitely distant far plane: floats then have the same relative
// precision at any distance, and the near plane can be very close.
constexpr double kNear_m = 0.5;

/// Balloon of balloon.glsl.
struct BalloonPush {
  float centerRadius[4];
  float upright[4];
  float colorOpacity[4];
};

constexpr uint32_t kBalloonVertices = 6 * 48 * 32;  // kAround x kDown cells of balloon.vert.

float narrow(double value) { return static_cast<float>(value); }

FrameBlock frameBlock(const Parameters& parameters, Projection projection, const FrameDesc& draw) {
  FrameBlock block = {};
  const Camera& camera = draw.cameras[0];
  clipFromCamera(projection, DepthConvention::Reversed, camera, block.clipFromCamera);
  const double r = std::hypot(camera.position[0], camera.position[1], camera.position[2]);
  const double scale = draw.radianceScale == 0.0 ? 1.0 : draw.radianceScale;
  for (uint32_t i = 0; i < 3; ++i) {
    block.upAltitude[i] = narrow(camera.position[i] / r);
    block.forwardParallel[i] = narrow(camera.forward[i]);
    block.sun[i] = narrow(draw.lights[0].direction[i]);
    block.irradiance[i] = narrow(parameters.solarIrradiance[i] * scale);
  }
  block.upAltitude[3] = narrow(std::max(r - parameters.bottomRadius_m, 0.0));
  block.forwardParallel[3] = projection == Projection::Orthographic ? 1.0f : 0.0f;
  return block;
}

BalloonPush balloonPush(const Parameters& parameters, const io::SceneBalloon& balloon,
                        const Camera& camera) {
  const Camera at = cameraAt(parameters, {}, balloon.latitude, balloon.longitude,
                             balloon.altitude_m, 0.0, 0.0, 0.0);
  BalloonPush push = {};
  for (uint32_t i = 0; i < 3; ++i) {
    push.centerRadius[i] = narrow(at.position[i] - camera.position[i]);
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
      mesh_(mesh),
      desc_(desc) {
  if (mesh != nullptr) {
    depth_ =
        gpu->image(desc.size, kDepthFormat,
                   VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, 1);
    depthAttachment_ = attachmentOf(depth_, kDepthRead.layout);
    uploadTerrain(*scene.terrain, albedo);
    if (desc.shafts.method != LightShaftMethod::Off) makeLightShafts();
  }
}

Landscape::~Landscape() = default;

void Landscape::follow(const View* view) {
  LandscapePipelinesDesc pipelines;
  pipelines.tables = desc_.tables;
  pipelines.colorFormat = desc_.colorFormat;
  pipelines.solver = desc_.solver;
  pipelines.mie = desc_.mie;
  pipelines.terrainAlbedo = mesh_ != nullptr ? &albedo_ : nullptr;
  pipelines.balloons = hasBalloons();
  ViewInfo info;
  gpu_->check(viewInfo(view, &info));
  pipelines.lightShaftLayout = info.setLayouts[kViewSetLightShafts];
  pipelines_.emplace(gpu_, pipelines);
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
  float rgba[4] = {0.0f, 0.0f, 0.0f, 1.0f};  // One texel, so that one shader serves both cases.
  for (uint32_t i = 0; i < kSpectrumSize; ++i) rgba[i] = static_cast<float>(terrain.albedo[i]);
  albedo_ = gpu_->texel(rgba);
}

void Landscape::uploadVertices() {
  vertices_ = gpu_->buffer(mesh_->vertices.size() * sizeof mesh_->vertices[0],
                           VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, mesh_->vertices.data());
  ++castersVersion_;
}

void Landscape::makeLightShafts() {
  LightShaftDesc& shafts = desc_.shafts;
  shafts.closed = true;
  shafts.adjacency = shafts.method == LightShaftMethod::ShadowVolume;
  if (shafts.adjacency) {
    const std::vector<uint32_t> indices = withAdjacency(*mesh_);
    adjacency_ = gpu_->buffer(indices.size() * sizeof(uint32_t), VK_BUFFER_USAGE_INDEX_BUFFER_BIT,
                              indices.data());
    adjacencyCount_ = indices.size();
  }
  shafts.vertexStride = sizeof(TerrainVertex);
  shafts.vertexOffset = offsetof(TerrainVertex, position);
}

void Landscape::describe(ViewDesc* view) const {
  if (mesh_ == nullptr) {
    view->aerialPerspective = AerialPerspective::Off;
    view->lightShafts.method = LightShaftMethod::Off;
    return;
  }
  view->depthFormat = kDepthFormat;
  view->depth = DepthConvention::Reversed;
  view->lightShafts = desc_.shafts;
  if (view->aerialPerspective == AerialPerspective::Off)
    view->lightShafts.method = LightShaftMethod::Off;
}

void Landscape::describe(FrameDesc* frame) const {
  setDepthPlanes(&frame->cameras[0]);
  if (mesh_ == nullptr) return;
  frame->sceneDepth = {depth_.view(), kDepthRead.layout, depth_.extent(), VK_NULL_HANDLE};
  Casters& casters = frame->casters;
  casters.bounds = mesh_->place.box;
  casters.version = castersVersion_;
  casters.user = const_cast<Landscape*>(this);
  casters.draw = [](void* user, VkCommandBuffer commands, const CasterPass& pass) {
    const auto* self = static_cast<const Landscape*>(user);
    placeCaster(pass, commands, self->mesh_->place.origin_m, nullptr);
    if (self->adjacencyCount_ > 0)
      self->drawTerrain(commands, self->adjacency_, self->adjacencyCount_);
    else
      self->drawTerrain(commands, self->indices_, self->mesh_->indices.size());
  };
}

void Landscape::setDepthPlanes(Camera* out) const {
  const Camera& camera = *out;
  if (projection_ != Projection::Orthographic) {
    out->nearPlane = kNear_m;
    out->farPlane = 0.0;
    return;
  }
  // Parallel rays need a far plane: behind all that is drawn.
  double most = 1.0;
  if (mesh_ != nullptr) {
    most = std::max(most, reachOf(mesh_->place.box, camera.position, camera.forward).most * 1.01);
  }
  for (const io::SceneBalloon& balloon : balloons_) {
    const Camera at = cameraAt(parameters_, {}, balloon.latitude, balloon.longitude,
                               balloon.altitude_m, 0.0, 0.0, 0.0);
    double along = 2.0 * balloon.radius_m;
    for (int i = 0; i < 3; ++i) along += (at.position[i] - camera.position[i]) * camera.forward[i];
    most = std::max(most, along);
  }
  out->nearPlane = 0.0;
  out->farPlane = most;
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

void Landscape::recordFrame(VkCommandBuffer commands, const FrameDesc& draw,
                            VkDescriptorSet shafts) {
  lightShaftSet_ = shafts;
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

void Landscape::setPicture(VkCommandBuffer commands, const FrameDesc& draw) const {
  const VkRect2D& area = draw.cameras[0].viewport;
  const VkViewport viewport = {static_cast<float>(area.offset.x),
                               static_cast<float>(area.offset.y),
                               static_cast<float>(area.extent.width),
                               static_cast<float>(area.extent.height),
                               0.0f,
                               1.0f};
  gpu_->function<PFN_vkCmdSetViewport>("vkCmdSetViewport")(commands, 0, 1, &viewport);
  gpu_->function<PFN_vkCmdSetScissor>("vkCmdSetScissor")(commands, 0, 1, &area);
}

void Landscape::placeTerrain(VkCommandBuffer commands, const FrameDesc& draw) const {
  float offset[4] = {};
  for (int i = 0; i < 3; ++i) {
    offset[i] = narrow(mesh_->place.origin_m[i] - draw.cameras[0].position[i]);
  }
  pipelines_->push(commands, offset, sizeof offset);
}

void Landscape::recordDepth(VkCommandBuffer commands, const FrameDesc& draw) const {
  gpu_->barrier(commands, depth_, {kUndefined.layout, kDepthRead.stage, VK_ACCESS_2_NONE},
                kDepthDrawn);
  VkRenderingAttachmentInfo attachment = depthAttachment_;
  attachment.imageLayout = kDepthDrawn.layout;
  attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;  // To 0, infinitely far.
  attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo rendering = {};
  rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  rendering.renderArea = draw.cameras[0].viewport;
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
                              const FrameDesc& draw) const {
  setPicture(commands, draw);
  pipelines_->bindTerrain(commands, tables, lightShaftSet_);
  placeTerrain(commands, draw);
  drawTerrain(commands, indices_, mesh_->indices.size());
}

void Landscape::recordBalloons(VkCommandBuffer commands, const Tables* tables,
                               const FrameDesc& draw) const {
  std::vector<BalloonPush> pushes;
  for (const io::SceneBalloon& balloon : balloons_) {
    pushes.push_back(balloonPush(parameters_, balloon, draw.cameras[0]));
  }
  const auto distance = [&](const BalloonPush& push) {
    const float* c = push.centerRadius;
    if (projection_ != Projection::Orthographic) return std::hypot(c[0], c[1], c[2]);
    const double* f = draw.cameras[0].forward;
    return narrow(c[0] * f[0] + c[1] * f[1] + c[2] * f[2]);
  };
  std::sort(pushes.begin(), pushes.end(), [&](const BalloonPush& a, const BalloonPush& b) {
    return distance(a) > distance(b);  // Farthest first, for blending.
  });
  setPicture(commands, draw);
  pipelines_->bindBalloons(commands, tables, lightShaftSet_);
  for (const BalloonPush& push : pushes) {
    pipelines_->push(commands, &push, sizeof push);
    gpu_->function<PFN_vkCmdDraw>("vkCmdDraw")(commands, kBalloonVertices, 1, 0, 0);
  }
}

}  // namespace alpenglow::samples
