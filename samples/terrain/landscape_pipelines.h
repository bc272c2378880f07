// Descriptor sets and pipelines of a landscape's triangles.
#pragma once

#include <alpenglow/view.h>

#include "common/gpu.h"

namespace alpenglow::samples {

inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

/// SceneFrame of scene_frame.glsl.
struct FrameBlock {
  float clipFromCamera[16];
  float upAltitude[4];
  float forwardParallel[4];
  float sun[4];
  float irradiance[4];
};

struct LandscapePipelinesDesc {
  const Tables* tables = nullptr;  ///< On the context of those that will be drawn with.
  VkFormat colorFormat = VK_FORMAT_UNDEFINED;
  Solver solver = Solver::Moments;                 ///< As the tables that will be drawn with.
  MieStorage mie = MieStorage::Full;               ///< The same.
  const headless::Image* terrainAlbedo = nullptr;  ///< Null: there is no terrain, and no depth.
  bool balloons = false;
  VkDescriptorSetLayout lightShaftLayout =
      VK_NULL_HANDLE;  ///< Of the view's light shafts; null: none.
};

class LandscapePipelines {
 public:
  static constexpr VkShaderStageFlags kPushStages =
      VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;

  /// `gpu` and the image outlive it. Throws an Error.
  LandscapePipelines(const Gpu* gpu, const LandscapePipelinesDesc& desc);

  /// Holds a FrameBlock for all pipelines.
  const headless::HostBuffer& frame() const { return frame_; }

  /// Each binds a pipeline with its sets.
  void bindDepth(VkCommandBuffer commands) const;
  void bindTerrain(VkCommandBuffer commands, const Tables* tables, VkDescriptorSet shafts) const;
  void bindBalloons(VkCommandBuffer commands, const Tables* tables, VkDescriptorSet shafts) const;
  /// Constants of the shaders: a place of the terrain, or a balloon.
  void push(VkCommandBuffer commands, const void* data, uint32_t bytes) const;

 private:
  void makeSets(const LandscapePipelinesDesc& desc);
  void makePipelines(const LandscapePipelinesDesc& desc);
  void bind(VkCommandBuffer commands, VkPipeline pipeline, const Tables* tables,
            VkDescriptorSet shafts) const;

  const Gpu* gpu_;
  VkDescriptorSetLayout lightShaftLayout_;
  headless::HostBuffer frame_;
  Owned<VkSampler> sampler_;
  Owned<VkDescriptorSetLayout> frameLayout_, albedoLayout_;
  Owned<VkDescriptorPool> pool_;
  VkDescriptorSet frameSet_ = VK_NULL_HANDLE, albedoSet_ = VK_NULL_HANDLE;
  Owned<VkPipelineLayout> layout_;
  Owned<VkPipeline> depth_, terrain_, balloon_;
};

}  // namespace alpenglow::samples
