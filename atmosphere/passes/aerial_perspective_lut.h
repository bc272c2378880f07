// The aerial-perspective LUT: light of the atmosphere between a frame's camera and any point in
// view, and the dispatch that fills it. shaders/glsl/physics/aerial_perspective_lut.glsl explains
// its contents. Of Solver::Moments.
#pragma once

#include "atmosphere/camera/camera_math.h"
#include "atmosphere/passes/lut.h"

namespace alpenglow::passes {

/// The mapping of a camera's rays to an aerial-perspective LUT.
physics_f64::AerialView aerialView(const Parameters& parameters, double altitude);

/// Inputs of shaders/glsl/common/aerial_perspective_lut.glsl for a draw.
struct AerialPerspectiveLookup {
  physics_f64::AerialView view;
  double up[3];          ///< The camera's vertical.
  double sunAzimuth[3];  ///< Horizontal unit vector towards the sun; 0 for one in the zenith.
};
AerialPerspectiveLookup aerialPerspectiveLookup(const Parameters& parameters,
                                                const FrameState& draw);

/// Owned by a view; externally synchronised.
class AerialPerspectiveLut {
 public:
  static constexpr uint32_t kImages = 3;

  explicit AerialPerspectiveLut(tables::Resources& resources) : lut_(resources) {}
  Status make(EffectFlags disabledEffects, VkPipelineStageFlags2 readers);
  void destroy(uint64_t frame) { lut_.destroy(frame); }
  bool made() const { return lut_.made(); }
  /// Extent of each image, for a view with these disabled effects.
  static VkExtent3D extentFor(EffectFlags disabledEffects);

  /// Whether it is up to date for this draw.
  bool current(const Tables& tables, const FrameState& draw) const;
  Status record(VkCommandBuffer commands, const Tables& tables, const FrameState& draw);
  Lut& lut() { return lut_; }
  const Lut& lut() const { return lut_; }
  /// 3D, for ALPENGLOW_AERIAL_PERSPECTIVE_BINDING + i, with Resources::sampler().
  const engine::Image& image(uint32_t i) const { return lut_.image(i); }

 private:
  Lut lut_;
};

}  // namespace alpenglow::passes
