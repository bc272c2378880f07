// The passes that find a frame's shadows in the air: what the public handle alpenglow::Shafts
// points to.
#pragma once

#include "atmosphere/bake/table_set.h"
#include "atmosphere/shafts/sun_map.h"

namespace alpenglow {
namespace shafts {

/// With the defaults filled in.
ShaftsDesc completed(const ShaftsDesc& desc);
/// Ok, or a sentence that names the wrong field. Of a completed description.
Status checkShaftsDesc(const engine::Device& device, const ShaftsDesc& desc);
/// Whether the draw's viewport lies in the scene's picture.
Status checkViewport(const engine::Device& device, const ShaftsDesc& desc, const SkyDraw& draw);
Status checkCasters(const engine::Device& device, const Casters& casters);

}  // namespace shafts

inline namespace v1 {

/// Externally synchronised.
struct Shafts {
 public:
  static Status create(bake::Resources& resources, const ShaftsDesc& desc, Shafts** out);
  static void destroy(Shafts* shafts, uint64_t frame);

  Status recordSunMap(VkCommandBuffer commands, const double sun[3], const Casters& casters);
  /// The draw has been checked. `air`: the set of an air volume that serves the draw, or null.
  Status record(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw,
                const Casters& casters, VkDescriptorSet air);

  const ShaftsDesc& desc() const { return desc_; }
  bake::Resources& resources() const { return resources_; }
  engine::Image& target(uint32_t i) { return targets_[i]; }
  VkDescriptorSetLayout setLayout() const { return setLayout_; }
  VkDescriptorSet set() const { return set_; }
  /// Whether they were recorded last for this draw's camera, sun and viewport.
  bool serves(const Tables& tables, const SkyDraw& draw) const;

 private:
  Shafts(bake::Resources& resources, const ShaftsDesc& desc)
      : resources_(resources), device_(resources.device()), desc_(desc), map_(resources) {}
  bool exact() const { return desc_.method == ShaftMethod::Exact; }
  bool mapped() const { return desc_.method != ShaftMethod::Paper; }
  /// Whether light comes from an air volume when there is one: a camera's rays share their
  /// observer.
  bool looksUp() const { return exact() && desc_.projection != Projection::Orthographic; }
  Status make();
  Status makeTargets();
  Status makeSet();
  Status makePipelines();
  Status makeCulling();
  Status makePipeline(bool fromVolume, VkPipeline* out);
  Status checkMap(const SkyDraw& draw) const;
  Status updateFrame(VkCommandBuffer commands, const shafts::ShaftFrame& frame);
  /// Which blocks of the surface between light and shadow this frame sees.
  Status cullBlocks(VkCommandBuffer commands);
  void drawSurface(VkCommandBuffer commands, const SkyDraw& draw, VkPipeline pipeline);
  Status drawShadows(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw,
                     const Casters& casters, VkDescriptorSet air);

  bake::Resources& resources_;
  engine::Device& device_;
  ShaftsDesc desc_;
  shafts::SunMap map_;
  engine::Buffer frame_, blocks_;  ///< AlpenglowShaftFrame; AlpenglowShaftBlocks, if exact.
  engine::Image targets_[2];       ///< Sums; bounds of the paper's.
  uint32_t targetCount_ = 0;
  engine::MemoryBlock memory_;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE, airLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;        ///< Integrates where it needs light.
  VkPipeline volumePipeline_ = VK_NULL_HANDLE;  ///< Looks it up.
  VkPipelineLayout cullLayout_ = VK_NULL_HANDLE;
  VkPipeline cullPipeline_ = VK_NULL_HANDLE;  ///< If exact.
  uint64_t tablesId_ = 0;                     ///< 0: nothing recorded yet.
  SkyDraw draw_;                              ///< Of the last record.
};

}  // namespace v1
}  // namespace alpenglow
