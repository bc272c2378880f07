// What the camera of a frame looks into, for all its rays, and the dispatch that fills it: light
// along rays (moments), or S at its altitude (standard).
#pragma once

#include <alpenglow/view.h>

#include "atmosphere/bake/table_set.h"
#include "atmosphere/sky/camera_math.h"

namespace alpenglow::sky {

/// What something was recorded for last: tables, and a camera's position and sun.
class RecordedFor {
 public:
  void set(const Tables& tables, const SkyDraw& draw);
  bool is(const Tables& tables, const SkyDraw& draw) const;

 private:
  uint64_t tablesId_ = 0;  ///< 0: nothing yet.
  double position_[3] = {};
  double sun_[3] = {};
};

/// Owned by a view; externally synchronised.
class SkySlice {
 public:
  /// For tables of this description, and a view without these effects.
  static Status create(bake::Resources& resources, const TableDesc& desc, EffectFlags without,
                       SkySlice** out);
  /// Texels of an image of it, and how many there are.
  static VkExtent3D extentFor(const TableDesc& desc, EffectFlags without);
  static uint32_t countFor(const TableDesc& desc, EffectFlags without);
  static void destroy(SkySlice* slice, uint64_t frame);

  /// Moments: any tables, whatever their quality.
  bool fits(const Tables& tables) const {
    if (solver_ == Solver::Moments) return true;
    const VkExtent3D other = extentFor(tables.desc(), without_);
    return other.width == extent_.width && other.height == extent_.height;
  }
  /// Both have been checked. Fills the slice and leaves it readable by fragment shaders.
  Status record(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw);
  /// Whether the slice, as recorded last, is what this draw looks into.
  bool serves(const Tables& tables, const SkyDraw& draw) const {
    return recorded_.is(tables, draw);
  }
  /// Whether there is a slice for the draw's camera: with moments always, else inside the
  /// atmosphere.
  static bool possible(const Tables& tables, const SkyDraw& draw);

  /// What needs no phase function, or C_*; single Mie scattering without its own, or C_M; when
  /// packed the first again, so that each binding has an image. Hillaire's has one: all light.
  const engine::Image& image() const { return images_[0]; }
  const engine::Image& mieImage() const { return images_[count_ - 1]; }
  /// Columns that sliceGrid counts, and rows.
  uint32_t columns() const { return columns_; }
  uint32_t rows() const { return extent_.height; }
  Status assertReadable() const;

 private:
  SkySlice(bake::Resources& resources, const TableDesc& desc, EffectFlags without)
      : resources_(resources),
        device_(resources.device()),
        solver_(desc.solver),
        without_(without),
        mie_(desc.mie),
        extent_(extentFor(desc, without)),
        columns_(extentFor(desc, 0).width),
        count_(countFor(desc, without)) {}
  Status make();
  Status makePipeline(TableFormat format);

  bake::Resources& resources_;
  engine::Device& device_;
  Solver solver_;
  EffectFlags without_;
  MieStorage mie_;
  VkExtent3D extent_;
  uint32_t columns_;
  uint32_t count_;
  engine::Image images_[2];
  engine::MemoryBlock block_;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  RecordedFor recorded_;
};

}  // namespace alpenglow::sky
