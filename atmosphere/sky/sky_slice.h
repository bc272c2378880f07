// The slice of S that the camera of a frame looks into, and the dispatch that fills it.
#pragma once

#include <alpenglow/view.h>

#include "atmosphere/bake/table_set.h"

namespace alpenglow::sky {

/// Distance from the planet's centre.
double cameraRadius(const Camera& camera);
/// The one subtraction that loses digits, taken in double (shaders/glsl/physics/geometry.glsl); 0
/// below the ground.
double cameraAltitude(const Parameters& parameters, const Camera& camera);

/// Owned by a view; externally synchronised.
class SkySlice {
 public:
  /// For tables of these sizes and storage.
  static Status create(bake::Resources& resources, const TableSizes& sizes, MieStorage mie,
                       SkySlice** out);
  static void destroy(SkySlice* slice, const FrameInfo& frame);

  bool fits(const Tables& tables) const {
    return tables.desc().sizes.scatteringMu == sizes_.scatteringMu &&
           tables.desc().sizes.scatteringNu == sizes_.scatteringNu;
  }
  /// Both have been checked. Fills the slice and leaves it readable by fragment shaders.
  Status record(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw);
  /// Whether the slice, as recorded last, is what this draw looks into.
  bool serves(const Tables& tables, const SkyDraw& draw) const;
  /// The camera of the draw is inside the atmosphere of the tables.
  static bool inside(const Tables& tables, const SkyDraw& draw);

  /// C_* and, not packed, C_M; when packed the first again, so that each binding has an image.
  const engine::Image& image() const { return images_[0]; }
  const engine::Image& mieImage() const { return images_[count_ - 1]; }
  Status assertReadable() const;

 private:
  SkySlice(bake::Resources& resources, const TableSizes& sizes, MieStorage mie)
      : resources_(resources),
        device_(resources.device()),
        sizes_(sizes),
        mie_(mie),
        count_(mie == MieStorage::Full ? 2 : 1) {}
  Status make();
  Status makePipeline(TableFormat format);

  bake::Resources& resources_;
  engine::Device& device_;
  TableSizes sizes_;
  MieStorage mie_;
  uint32_t count_;
  engine::Image images_[2];
  engine::MemoryBlock block_;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;

  uint64_t tablesId_ = 0;  ///< 0: nothing recorded yet.
  double position_[3] = {};
  double sun_[3] = {};
};

}  // namespace alpenglow::sky
