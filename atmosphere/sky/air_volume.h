// Light of the air between a frame's camera and whatever it sees, at all distances, and the
// dispatch that fills it: shaders/glsl/physics/air_volume.glsl says what it holds. Of
// Solver::Moments.
#pragma once

#include "atmosphere/sky/sky_slice.h"

namespace alpenglow::sky {

/// How a camera's rays lie in an air volume.
physics_f64::AirView airView(const Parameters& parameters, double altitude);

/// What shaders/glsl/common/air_volume.glsl wants to know of a draw.
struct AirLookup {
  physics_f64::AirView view;
  double up[3];          ///< The camera's vertical.
  double sunAzimuth[3];  ///< Horizontal unit vector towards the sun; 0 for one in the zenith.
};
AirLookup airLookup(const Parameters& parameters, const SkyDraw& draw);

/// Owned by whoever draws with it; externally synchronised.
class AirVolume {
 public:
  static constexpr uint32_t kImages = 3;

  static Status create(bake::Resources& resources, EffectFlags without, AirVolume** out);
  static void destroy(AirVolume* volume, uint64_t frame);
  /// Of each of its images, for a view without these effects.
  static VkExtent3D extentFor(EffectFlags without);

  /// Both have been checked; tables of Solver::Moments. Fills the volume and leaves it readable by
  /// fragment and compute shaders.
  Status record(VkCommandBuffer commands, const Tables& tables, const SkyDraw& draw);
  /// Whether the volume, as recorded last, is what this draw looks into.
  bool serves(const Tables& tables, const SkyDraw& draw) const {
    return recorded_.is(tables, draw);
  }

  /// 3D, for ALPENGLOW_AIR_BINDING + i, with Resources::sampler().
  const engine::Image& image(uint32_t i) const { return images_[i]; }
  Status assertReadable() const;
  uint64_t bytes() const;  ///< Of its images.

 private:
  AirVolume(bake::Resources& resources, EffectFlags without)
      : resources_(resources), device_(resources.device()), without_(without) {}
  Status make();
  Status makeSet();
  Status makePipeline();

  bake::Resources& resources_;
  engine::Device& device_;
  EffectFlags without_;  ///< As the tables.
  TableFormat format_ = TableFormat::Half;
  engine::Image images_[kImages];
  engine::MemoryBlock block_;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  RecordedFor recorded_;
};

}  // namespace alpenglow::sky
