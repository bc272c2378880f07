// The map from the sun: depth of what its beam meets first.
#pragma once

#include "atmosphere/bake/resources.h"
#include "atmosphere/shafts/caster_pass.h"
#include "engine/memory.h"

namespace alpenglow::shafts {

inline constexpr VkFormat kSunMapFormat = VK_FORMAT_D32_SFLOAT;

/// Owned by Shafts; externally synchronised.
class SunMap {
 public:
  explicit SunMap(bake::Resources& resources) : device_(resources.device()) {}
  Status make(const ShaftsDesc& desc);
  void destroy(const FrameInfo& frame);

  /// Leaves the image readable by vertex and fragment shaders.
  Status record(VkCommandBuffer commands, const double sun[3], const Casters& casters);

  /// The sun that it was recorded for last; a zero vector before.
  const double* sun() const { return place_.sun; }
  const SunMapPlace& place() const { return place_; }
  engine::Image& depth() { return depth_; }

 private:
  Status makeImage();
  Status makePipeline(const ShaftsDesc& desc);

  engine::Device& device_;
  uint32_t size_ = 0;
  SunMapPlace place_;
  engine::Image depth_;
  engine::MemoryBlock memory_;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};

}  // namespace alpenglow::shafts
