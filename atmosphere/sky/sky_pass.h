// The pass that draws sky, sun disc and ground: what the public handle alpenglow::View points to.
#pragma once

#include <alpenglow/view.h>

#include "atmosphere/bake/table_set.h"
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

/// Fills the constants; everything is computed in double and rounded once.
SkyConstants makeConstants(const Parameters& parameters, const ViewDesc& desc, const SkyDraw& draw);
/// Ok, or a sentence that names the wrong field.
Status checkDraw(const engine::Device& device, const ViewDesc& desc, const SkyDraw& draw);
Status checkViewDesc(const engine::Device& device, const ViewDesc& desc);

}  // namespace sky

inline namespace v1 {

/// Externally synchronised.
struct View {
 public:
  static Status create(bake::Resources& resources, const ViewDesc& desc, View** out);
  static void destroy(View* view, const FrameInfo& frame);
  Status recordSlice(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw);
  Status recordSky(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw);
  void collect(const FrameInfo& frame) { device_.deletions().collect(frame.completed); }

 private:
  View(bake::Resources& resources, const ViewDesc& desc)
      : resources_(resources), device_(resources.device()), desc_(desc) {}
  Status makeSlice();
  Status makeLayout();
  Status makeSet(const VkDescriptorSetLayoutBinding* bindings, uint32_t count);
  Status makePipelines(bool slice, VkPipeline* pipelines);
  /// A draw for each part, ordered by pipeline.
  void drawParts(VkCommandBuffer commands, const sky::Parts& parts, const VkOffset2D& corner,
                 const VkPipeline* pipelines);
  Status checkRecord(const Tables& tables, const SkyDraw& draw, const char* call) const;

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
};

}  // namespace v1
}  // namespace alpenglow
