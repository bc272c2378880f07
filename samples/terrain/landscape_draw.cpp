// What a landscape records into a frame.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "landscape.h"
#include "tables_info.h"

namespace alpenglow::samples {
namespace {

/// SceneFrame of scene_frame.glsl.
struct FrameBlock {
  float clipFromCamera[16];
  float upAltitude[4];
  float forwardParallel[4];
  float sun[4];
  float irradiance[4];
};

/// Balloon of balloon.glsl.
struct BalloonPush {
  float centerRadius[4];
  float upright[4];
  float colorOpacity[4];
};

constexpr uint32_t kBalloonVertices = 6 * 48 * 32;  // kAround x kDown cells of balloon.vert.
constexpr VkShaderStageFlags kPushStages =
    VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

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

}  // namespace

void Landscape::recordFrame(VkCommandBuffer commands, const SkyDraw& draw) const {
  const FrameBlock block = frameBlock(parameters_, projection_, draw);
  constexpr VkPipelineStageFlags2 kReaders =
      VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  const ImageState read = {VK_IMAGE_LAYOUT_UNDEFINED, kReaders, VK_ACCESS_2_UNIFORM_READ_BIT};
  const ImageState written = {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                              VK_ACCESS_2_TRANSFER_WRITE_BIT};
  gpu_->barrier(commands, read, written);  // The last frame may still read it.
  gpu_->function<PFN_vkCmdUpdateBuffer>("vkCmdUpdateBuffer")(commands, frame_.buffer(), 0,
                                                             sizeof block, &block);
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

void Landscape::bind(VkCommandBuffer commands, VkPipeline pipeline, const Tables* tables) const {
  const auto bindSets = gpu_->function<PFN_vkCmdBindDescriptorSets>("vkCmdBindDescriptorSets");
  const auto bindSet = [&](uint32_t index, VkDescriptorSet set) {
    if (set == VK_NULL_HANDLE) return;
    bindSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), index, 1, &set, 0, nullptr);
  };
  gpu_->function<PFN_vkCmdBindPipeline>("vkCmdBindPipeline")(
      commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
  bindSet(0, infoOf(tables).set);
  bindSet(1, frameSet_);
  bindSet(2, albedoSet_);
  bindSet(3, shafts_ != nullptr && tables != nullptr ? shaftSet(shafts_) : VK_NULL_HANDLE);
}

void Landscape::placeTerrain(VkCommandBuffer commands, const SkyDraw& draw) const {
  float offset[4] = {};
  for (int i = 0; i < 3; ++i) {
    offset[i] = narrow(mesh_->place.origin_m[i] - draw.camera.position_m[i]);
  }
  gpu_->function<PFN_vkCmdPushConstants>("vkCmdPushConstants")(commands, layout_.get(), kPushStages,
                                                               0, sizeof offset, offset);
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
  bind(commands, depthPipeline_.get(), nullptr);
  placeTerrain(commands, draw);
  drawTerrain(commands, indices_, mesh_->indices.size());
  gpu_->function<PFN_vkCmdEndRendering>("vkCmdEndRendering")(commands);
  gpu_->barrier(commands, depth_, kDepthDrawn, kDepthRead);
}

void Landscape::recordTerrain(VkCommandBuffer commands, const Tables* tables,
                              const SkyDraw& draw) const {
  setPicture(commands, draw);
  bind(commands, terrainPipeline_.get(), tables);
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
  bind(commands, balloonPipeline_.get(), tables);
  for (const BalloonPush& push : pushes) {
    gpu_->function<PFN_vkCmdPushConstants>("vkCmdPushConstants")(
        commands, layout_.get(), kPushStages, 0, sizeof push, &push);
    gpu_->function<PFN_vkCmdDraw>("vkCmdDraw")(commands, kBalloonVertices, 1, 0, 0);
  }
}

}  // namespace alpenglow::samples
