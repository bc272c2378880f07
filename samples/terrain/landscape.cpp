#include "landscape.h"

#include <algorithm>
#include <cmath>

namespace alpenglow::samples {
namespace {

// Depth is reversed and infinitely far: floats have the same digits at any distance then, and the
// near plane can be as close as anyone's nose.
constexpr double kNear_m = 0.5;

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

Projection projectionOf(const io::SceneCamera& camera) {
  return camera.orthographicHeight_m ? Projection::Orthographic : camera.projection;
}

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
  makeSets(desc.tables);
  makePipelines(desc);
}

Landscape::~Landscape() {
  if (shafts_ != nullptr) destroyShafts(shafts_, gpu_->frame());
}

void Landscape::uploadTerrain(const io::SceneTerrain& terrain, const io::AlbedoMap* albedo) {
  const auto filled = [&](const auto& array, VkBufferUsageFlags usage) {
    return gpu_->buffer(array.size() * sizeof array[0], usage, array.data());
  };
  uploadVertices();
  indices_ = filled(mesh_->indices, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
  sampler_ = gpu_->sampler(VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE);
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

}  // namespace alpenglow::samples
