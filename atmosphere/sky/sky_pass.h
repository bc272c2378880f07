// The pass that draws sky, sun disc and ground: what the public handle alpenglow::View points to.
#pragma once

#include <alpenglow/view.h>

#include "atmosphere/bake/table_set.h"
#include "atmosphere/sky/air_volume.h"
#include "atmosphere/sky/parts.h"
#include "atmosphere/sky/sky_slice.h"

namespace alpenglow {
namespace sky {

/// Push constants of sky.frag: shaders/glsl/sky/sky.frag says what each is.
struct SkyConstants {
  float upAltitude[4];
  float forwardPixel[4];
  float rightHalfAngle[4];
  float downMapTexel[4];
  float sunDiscChord[4];
  float irradianceDisc[4];
  float circleSlice[4];
  float sunAzimuth[4];
};
static_assert(sizeof(SkyConstants) == 128, "Vulkan guarantees 128 bytes");

/// Push constants of air.frag, likewise.
struct AirConstants {
  float upAltitude[4];
  float forwardA[4];
  float rightB[4];
  float downExtinction[4];
  float sunHeight[4];
  float irradiance[4];
  float slice[4];
  float sunAzimuth[4];
};
static_assert(sizeof(AirConstants) == sizeof(SkyConstants), "Both share a layout");

/// What light shafts give a view: the set of alpenglow/shafts.glsl. A null layout: none.
struct ShaftSet {
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;
  uint32_t method = 0;  ///< ShaftMethod.
  uint32_t samples = 0;
  float multipleLoss = 0.0f;
};

/// Fills the constants; everything is computed in double and rounded once.
SkyConstants makeConstants(const Parameters& parameters, const ViewDesc& desc, const SkyDraw& draw);
AirConstants makeAirConstants(const Parameters& parameters, const ViewDesc& desc,
                              const SkyDraw& draw);
/// Ok, or a sentence that names the wrong field.
Status checkDraw(const engine::Device& device, Projection projection, const SkyDraw& draw);
Status checkDepthRange(const engine::Device& device, Projection projection,
                       const DepthRange& range);
/// A unit vector, or a sentence with its name.
Status checkDirection(const engine::Device& device, const char* name, const double direction[3]);
Status checkViewDesc(const engine::Device& device, const ViewDesc& desc);
/// Ok, or a sentence when the draw's camera, or a part of it, sees what the view is without.
Status checkDrawnEffects(const engine::Device& device, const Parameters& parameters,
                         const ViewDesc& desc, const SkyDraw& draw);
Status checkParts(const engine::Device& device, const ViewDesc& desc, const Parts& parts);

}  // namespace sky

inline namespace v1 {

/// Externally synchronised.
struct View {
 public:
  static Status create(bake::Resources& resources, const ViewDesc& desc,
                       const sky::ShaftSet& shafts, View** out);
  static void destroy(View* view, uint64_t frame);
  Status recordSlice(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw);
  // The draw of the next two has been checked (checkRecord).
  Status recordSky(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw);
  Status recordAir(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw);
  /// The set of an air volume that serves the draw, or null.
  VkDescriptorSet airSet(const Tables& tables, const SkyDraw& draw) const;
  Status checkRecord(const Tables& tables, const SkyDraw& draw, const char* call) const;
  const ViewDesc& desc() const { return desc_; }
  bake::Resources& resources() const { return resources_; }

 private:
  View(bake::Resources& resources, const ViewDesc& desc, const sky::ShaftSet& shafts)
      : resources_(resources), device_(resources.device()), desc_(desc), shafts_(shafts) {}
  bool hasAir() const { return desc_.sceneDepth.view != VK_NULL_HANDLE; }
  Status makeAir();
  Status makeAirPipelines();
  Status makeAirPipeline(bool fromVolume, VkPipeline* out);
  Status makeSlice();
  Status makeLayout();
  Status makeSet(const VkDescriptorSetLayoutBinding* bindings, uint32_t count);
  Status makePipelines(bool slice, VkPipeline* pipelines);
  Status refuseEffects(EffectFlags tables) const;
  Status refuseUnsliced(const char* call) const;
  void bindSets(VkCommandBuffer commands, const Tables& tables);
  /// A draw for each part, ordered by pipeline.
  void drawParts(VkCommandBuffer commands, const sky::Parts& parts, const VkOffset2D& corner,
                 const VkPipeline* pipelines);

  bake::Resources& resources_;
  engine::Device& device_;
  ViewDesc desc_;
  sky::SkySlice* slice_ = nullptr;                    ///< Only with ViewDesc::skySlice.
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;  ///< Only with a map or a slice.
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipelines_[sky::kVariants] = {};
  VkPipeline slicePipelines_[sky::kVariants] = {};  ///< Only with a slice.

  // Aerial perspective: only with a scene's depth.
  sky::ShaftSet shafts_;
  sky::AirVolume* volume_ = nullptr;  ///< Only with a slice of moments.
  VkDescriptorSetLayout airLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool airPool_ = VK_NULL_HANDLE;
  VkDescriptorSet airSet_ = VK_NULL_HANDLE;
  VkPipeline airPipeline_ = VK_NULL_HANDLE;        ///< Integrates through the tables.
  VkPipeline airVolumePipeline_ = VK_NULL_HANDLE;  ///< Looks it up.
};

}  // namespace v1
}  // namespace alpenglow
