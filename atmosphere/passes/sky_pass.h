// The passes that draw into a host's rendering scope: sky, sun disc and ground; and aerial
// perspective over a host's scene. Both share push constants, sets and a pipeline layout.
#pragma once

#include "atmosphere/camera/viewport_partition.h"
#include "atmosphere/passes/aerial_perspective_lut.h"
#include "atmosphere/passes/sky_view_lut.h"
#include "atmosphere/tables/table_set.h"

namespace alpenglow::passes {

/// Push constants of sky.frag: shaders/glsl/passes/sky.frag explains each member.
struct SkyConstants {
  float upAltitude[4];
  float forwardPixel[4];
  float rightHalfAngle[4];
  float downMapTexel[4];
  float sunDiscChord[4];
  float irradianceDisc[4];
  float circleSkyView[4];
  float sunAzimuth[4];
};
static_assert(sizeof(SkyConstants) == 128, "Vulkan guarantees 128 bytes");

/// Push constants of aerial_perspective.frag, likewise.
struct AerialPerspectiveConstants {
  float upAltitude[4];
  float forwardA[4];
  float rightB[4];
  float downExtinction[4];
  float sunHeight[4];
  float irradiance[4];
  float skyView[4];
  float sunAzimuth[4];
};
static_assert(sizeof(AerialPerspectiveConstants) == sizeof(SkyConstants), "Both share a layout");

/// Light shafts of a picture: the set of alpenglow/light_shafts.glsl. A null layout: none.
struct LightShaftSet {
  VkDescriptorSetLayout layout = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;
  uint32_t method = 0;  ///< methodIndex(): LightVolume 0, ShadowVolume 1, RayMarch 2.
  uint32_t stepCount = 0;
  float multipleLoss = 0.0f;
};

/// Sets 0 to 3 of the pipelines: tables, picture, aerial-perspective LUT, light shafts.
struct PictureSets {
  VkDescriptorSet sets[kViewSetCount] = {};
  void bind(const engine::Device& device, VkCommandBuffer commands, VkPipelineLayout layout) const;
};

/// Fills the constants; everything is computed in double and rounded once.
SkyConstants makeSkyConstants(const Parameters& parameters, const PictureDesc& desc,
                              const FrameState& draw);
AerialPerspectiveConstants makeAerialPerspectiveConstants(const Parameters& parameters,
                                                          const PictureDesc& desc,
                                                          const FrameState& draw);
/// Whether the viewport can be divided into parts: what checkDraw requires of a camera.
bool drawable(Projection projection, const FrameState& draw);
/// Ok, or a sentence that names the wrong field.
Status checkDraw(const engine::Device& device, Projection projection, const FrameState& draw);
Status checkDepthRange(const engine::Device& device, Projection projection,
                       const DepthRange& range);
/// A unit vector, or a sentence with its name.
Status checkDirection(const engine::Device& device, const char* name, const double direction[3]);
/// Ok, or a sentence when a part of the draw shows an effect that the view has disabled.
Status checkDrawnEffects(const engine::Device& device, const Parameters& parameters,
                         const PictureDesc& desc, const FrameState& draw);
Status checkPartition(const engine::Device& device, const PictureDesc& desc,
                      const ViewportPartition& parts);

/// Sky, sun disc and ground. Owned by a view; externally synchronised.
class SkyPass {
 public:
  explicit SkyPass(engine::Device& device) : device_(device) {}
  /// `lut`: that of the picture, or null.
  Status make(const PictureDesc& desc, const LightShaftSet& shafts, const SkyViewLut* lut,
              VkPipelineLayout layout);
  void destroy(uint64_t frame);
  /// A draw for each part, ordered by pipeline.
  void record(VkCommandBuffer commands, const SkyConstants& constants, const PictureSets& sets,
              const VkRect2D& viewport, const ViewportPartition& parts, bool fromLut);

 private:
  Status makePipelines(const PictureDesc& desc, const LightShaftSet& shafts, const SkyViewLut* lut,
                       VkPipeline* pipelines);

  engine::Device& device_;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipelines_[kVariants] = {};
  VkPipeline lutPipelines_[kVariants] = {};
};

/// Aerial perspective. Owned by a view; externally synchronised.
class AerialPerspectivePass {
 public:
  explicit AerialPerspectivePass(engine::Device& device) : device_(device) {}
  Status make(const PictureDesc& desc, const LightShaftSet& shafts, VkPipelineLayout layout);
  void destroy(uint64_t frame);
  void record(VkCommandBuffer commands, const AerialPerspectiveConstants& constants,
              const PictureSets& sets, const VkRect2D& viewport, bool fromLut);

 private:
  Status makePipeline(const PictureDesc& desc, const LightShaftSet& shafts, bool fromLut,
                      VkPipeline* out);

  engine::Device& device_;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;     ///< Integrates through the tables.
  VkPipeline lutPipeline_ = VK_NULL_HANDLE;  ///< Looks it up.
};

}  // namespace alpenglow::passes
