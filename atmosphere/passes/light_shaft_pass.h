// The pass that computes a frame's shadows in the atmosphere.
#pragma once

#include "atmosphere/passes/shadow_map.h"
#include "atmosphere/tables/table_set.h"

namespace alpenglow::passes {

/// With the defaults filled in.
LightShaftSettings completed(const LightShaftSettings& desc);
/// Ok, or a sentence that names the wrong field. Of completed settings.
Status checkLightShaftSettings(const engine::Device& device, const LightShaftSettings& desc);
/// Whether the draw's viewport lies in the scene's picture.
Status checkViewport(const engine::Device& device, const VkExtent2D& scene, const FrameState& draw);
Status checkCasters(const engine::Device& device, const CasterSet& casters);

/// Owned by a view; externally synchronised.
class LightShaftPass {
 public:
  explicit LightShaftPass(tables::Resources& resources)
      : resources_(resources), device_(resources.device()), map_(device_) {}
  LightShaftPass(const LightShaftPass&) = delete;
  LightShaftPass& operator=(const LightShaftPass&) = delete;
  /// The settings have been completed and checked. `stages`: of the host's shaders that bind the
  /// set.
  Status make(const LightShaftSettings& desc, VkShaderStageFlags stages);
  void destroy(uint64_t frame);
  bool made() const { return setLayout_ != VK_NULL_HANDLE; }

  /// Before anything of a frame is recorded: makes what depends on the extent of the scene's depth.
  Status resize(VkExtent2D scene);
  Status recordShadowMap(VkCommandBuffer commands, const double sun[3], const CasterSet& casters);
  /// The frame has been checked. `lut`: the set of its aerial-perspective LUT, or null. Unless
  /// casters.lit nothing is drawn, and the images hold nothing.
  Status record(VkCommandBuffer commands, const Tables& tables, const FrameState& draw,
                const HostImage& sceneDepth, const CasterSet& casters, VkDescriptorSet lut);
  void abandon(uint64_t frame) { map_.abandon(frame); }

  const LightShaftSettings& desc() const { return desc_; }
  const ShadowMap& map() const { return map_; }
  bool mapped() const { return desc_.method != LightShaftMethod::ShadowVolume; }
  const engine::Image& target(uint32_t i) const { return targets_[i]; }
  engine::Image& target(uint32_t i) { return targets_[i]; }
  uint32_t targetCount() const { return targetCount_; }
  VkDescriptorSetLayout setLayout() const { return setLayout_; }
  VkDescriptorSet set() const { return set_; }

 private:
  bool exact() const { return desc_.method == LightShaftMethod::LightVolume; }
  /// Whether light comes from an aerial-perspective LUT when there is one: a camera's rays share
  /// their observer.
  bool looksUp() const { return exact() && desc_.projection != Projection::Orthographic; }
  uint32_t wantedTargets() const {
    return desc_.method == LightShaftMethod::ShadowVolume ? 2 : exact() ? 1 : 0;
  }
  VkFormat targetFormat() const;
  /// Only what the set of a frame without shadows needs.
  Status recordNone(VkCommandBuffer commands);
  Status makeBuffers();
  Status makeTargets();
  void describeBindings(VkDescriptorSetLayoutBinding* bindings) const;
  Status makeLayout();
  Status makeSet();
  Status makePipelines();
  Status makeCulling();
  Status makePipeline(bool fromLut, VkPipeline* out);
  void dropTargets(uint64_t frame);
  Status updateFrame(VkCommandBuffer commands, const LightShaftFrame& frame);
  /// Culls the blocks of the light-volume mesh.
  Status cullBlocks(VkCommandBuffer commands);
  void drawSurface(VkCommandBuffer commands, const FrameState& draw, VkPipeline pipeline);
  Status drawShadows(VkCommandBuffer commands, const Tables& tables, const FrameState& draw,
                     const HostImage& sceneDepth, const CasterSet& casters, VkDescriptorSet lut);

  tables::Resources& resources_;
  engine::Device& device_;
  LightShaftSettings desc_;
  VkShaderStageFlags stages_ = 0;
  ShadowMap map_;
  VkExtent2D extent_ = {};  ///< Of the targets.
  engine::Buffer frame_,
      blocks_;  ///< AlpenglowLightShaftFrame; AlpenglowLightShaftBlocks, if exact.
  engine::MemoryBlock bufferMemory_;
  engine::Image targets_[2];  ///< Sums; bounds of ShadowVolume.
  uint32_t targetCount_ = 0;
  engine::MemoryBlock targetMemory_;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE, lutLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;     ///< Integrates where it needs light.
  VkPipeline lutPipeline_ = VK_NULL_HANDLE;  ///< Looks it up.
  VkPipelineLayout cullLayout_ = VK_NULL_HANDLE;
  VkPipeline cullPipeline_ = VK_NULL_HANDLE;  ///< If exact.
};

}  // namespace alpenglow::passes
