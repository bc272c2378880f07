// The shadow map: depth of the first caster along the sun's beam.
#pragma once

#include "atmosphere/passes/caster_pass.h"
#include "engine/memory.h"

namespace alpenglow::passes {

inline constexpr VkFormat kShadowMapFormat = VK_FORMAT_D32_SFLOAT;

/// Owned by LightShaftPass; externally synchronised.
class ShadowMap {
 public:
  explicit ShadowMap(engine::Device& device) : device_(device) {}
  Status make(const LightShaftSettings& desc);
  void destroy(uint64_t frame);

  /// Whether it holds these casters under this sun: same version, not 0; same sun and bounds,
  /// except for rounding.
  bool current(const double sun[3], const CasterSet& casters) const;
  /// Whether it was drawn for this sun.
  bool drawnFor(const double sun[3]) const;
  /// Leaves the image readable by vertex and fragment shaders.
  Status record(VkCommandBuffer commands, const double sun[3], const CasterSet& casters);
  /// Makes the image readable where it was never drawn: its contents are undefined.
  Status recordReadable(VkCommandBuffer commands);
  /// Commands of that frame never execute.
  void abandon(uint64_t frame) {
    if (frame_ >= frame) recorded_ = false;
  }

  /// The sun that it was recorded for last.
  const double* sun() const { return place_.sun; }
  const ShadowMapPlace& place() const { return place_; }
  const engine::Image& depth() const { return depth_; }

 private:
  Status makeImage();
  Status makePipeline(const LightShaftSettings& desc);

  engine::Device& device_;
  uint32_t size_ = 0;
  LightShaftMethod method_ = LightShaftMethod::Off;
  ShadowMapPlace place_;
  bool recorded_ = false;
  uint64_t frame_ = 0;  ///< In which it was recorded.
  uint64_t version_ = 0;
  PlanetBox bounds_;
  engine::Image depth_;
  engine::MemoryBlock memory_;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace alpenglow::passes
