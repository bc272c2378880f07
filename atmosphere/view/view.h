// Composes the passes of one picture. The public handle alpenglow::View points to it.
#pragma once

#include "atmosphere/passes/light_shaft_pass.h"
#include "atmosphere/passes/sky_pass.h"
#include "atmosphere/view/frame.h"
#include "atmosphere/view/view_desc.h"
#include "atmosphere/view/warnings.h"
#include "engine/frame_sets.h"
#include "engine/frames.h"

namespace alpenglow {
inline namespace v1_0 {

/// Externally synchronised, but for the record functions after beginFrame (alpenglow/view.h).
struct View : public engine::FrameObject {
 public:
  /// The description has been checked. `tables` stay the default of FrameDesc::tables.
  static Status create(tables::Resources& resources, const Tables& tables, const ViewDesc& desc,
                       View** out);
  static void destroy(View* view, uint64_t frame);

  Status beginFrame(const FrameDesc& desc, FrameWork* work);
  Status recordLuts(VkCommandBuffer commands);
  Status recordShadowMap(VkCommandBuffer commands);
  Status recordLightShafts(VkCommandBuffer commands);
  Status recordAerialPerspective(VkCommandBuffer commands);
  Status recordSky(VkCommandBuffer commands);
  void info(ViewInfo* out) const;

  void frameCompleted(uint64_t) override {}
  void frameAbandoned(uint64_t frame) override;
  void objectDestroyed(const FrameObject* object) override;
  void destroyNow() override { destroy(this, 0); }

  tables::Resources& resources() const { return resources_; }
  const PictureDesc& picture() const { return desc_.picture; }
  passes::LightShaftPass& lightShafts() { return lightShafts_; }
  passes::SkyViewLut& skyLut() { return skyLut_; }
  passes::AerialPerspectiveLut& aerialLut() { return aerialLut_; }

 private:
  View(tables::Resources& resources, const Tables& tables, const ViewDesc& desc);
  ~View() override = default;
  Status make(const Tables& tables);
  Status makeSets();
  Status makePipelines();
  Status checkTables(const Tables& tables) const;
  Status takeFrame(const FrameDesc& desc);
  Status prepareSets();
  void answer(FrameWork* work) const;
  RecordFlags needed() const;
  /// Ok, NotReady where beginFrame failed, or a sentence when it was not called for this frame.
  Status checkBegun(const char* call) const;
  bool skyFromLut() const;

  tables::Resources& resources_;
  engine::Device& device_;
  view::ResolvedView desc_;
  const Tables* tables_;  ///< Of createView.
  uint64_t tablesId_;
  TableDesc shape_;  ///< Of the tables of createView.

  passes::SkyViewLut skyLut_;
  passes::AerialPerspectiveLut aerialLut_;
  passes::LightShaftPass lightShafts_;
  passes::SkyPass skyPass_;
  passes::AerialPerspectivePass aerialPass_;
  engine::FrameSets pictureSets_;  ///< Set 1.
  bool hasPictureSet_ = false;
  VkDescriptorSet fixedSet_ = VK_NULL_HANDLE;  ///< Set 1 of a view without scene depth.
  VkDescriptorSetLayout aerialLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool aerialPool_ = VK_NULL_HANDLE;
  VkDescriptorSet aerialSet_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;

  /// This frame, as beginFrame fixed it.
  struct Frame {
    uint64_t number = 0;  ///< 0: beginFrame has never been called.
    bool valid = false;
    const Tables* tables = nullptr;
    FrameState state;
    HostImage sceneDepth;
    CasterSet casters;
    passes::ViewportPartition parts;
    passes::SkyConstants skyConstants;
    passes::AerialPerspectiveConstants aerialConstants;
    passes::PictureSets sets;
    bool mapRecorded = false;  ///< The shadow map was drawn.
    bool lightShaftsRecorded = false;
  };
  Frame frame_;
  view::Warnings warnings_;
};

}  // namespace v1_0
}  // namespace alpenglow
