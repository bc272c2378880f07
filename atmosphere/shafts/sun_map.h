// The map from the sun: depth of what its beam meets first, and the greatest depth of each block of
// texels, by which walls of shadow end.
#pragma once

#include "atmosphere/bake/resources.h"
#include "atmosphere/shafts/caster_pass.h"
#include "engine/memory.h"

namespace alpenglow::shafts {

inline constexpr uint32_t kSunMapBlock = 8;  ///< Also in shaders/glsl/shafts/sun_blocks.comp.
inline constexpr VkFormat kSunMapFormat = VK_FORMAT_D32_SFLOAT;

/// Owned by Shafts; externally synchronised.
class SunMap {
 public:
  explicit SunMap(bake::Resources& resources)
      : resources_(resources), device_(resources.device()) {}
  /// `blocks`: also the images of blocks, which walls need.
  Status make(const ShaftsDesc& desc, bool blocks);
  void destroy(const FrameInfo& frame);

  /// Leaves the images readable by geometry and fragment shaders.
  Status record(VkCommandBuffer commands, const double sun[3], const Casters& casters);

  /// The sun that it was recorded for last; a zero vector before.
  const double* sun() const { return place_.sun; }
  const SunMapPlace& place() const { return place_; }
  engine::Image& depth() { return depth_; }
  engine::Image& blocks() { return blocks_[1]; }

 private:
  Status makeImages();
  Status makeSets();
  Status makePipelines(const ShaftsDesc& desc);
  Status recordBlocks(VkCommandBuffer commands);

  bake::Resources& resources_;
  engine::Device& device_;
  uint32_t size_ = 0;
  bool hasBlocks_ = false;
  SunMapPlace place_;
  engine::Image depth_, blocks_[2];  ///< Each block's own; with those around it.
  engine::MemoryBlock memory_;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet sets_[2] = {};
  VkPipelineLayout drawLayout_ = VK_NULL_HANDLE, blocksLayout_ = VK_NULL_HANDLE;
  VkPipeline drawPipeline_ = VK_NULL_HANDLE, blocksPipelines_[2] = {};
};

}  // namespace alpenglow::shafts
