// What all tables of a context share: layouts, samplers, and the pipelines of the stages.
#pragma once

#include <array>
#include <atomic>
#include <compare>
#include <map>
#include <mutex>
#include <utility>

#include "atmosphere/tables/bake_graph.h"
#include "engine/descriptors.h"
#include "engine/pipeline.h"

namespace alpenglow::tables {

/// Push constants of every bake shader: shaders/glsl/tables/common.glsl.
struct TileConstants {
  uint32_t firstRow, endRow, width, height;
};

inline constexpr uint32_t kTableBindings = 1 + kBoundTables;  ///< Uniforms and sampled tables.
inline constexpr uint32_t kInputBindings = 1 + kMaxInputs;    ///< Uniforms and sampled images.

/// Float where the device stores and filters it, else `otherwise`: for values that are subtracted
/// from each other, or that must not add rounding to the tables.
TableFormat finestFormat(const engine::Device& device, TableFormat otherwise);

/// Made with the context, destroyed with it. Thread-safe.
class Resources {
 public:
  /// `setStages`: of the host's shaders that bind our sets, besides compute and fragment.
  static Status create(engine::Device& device, VkShaderStageFlags setStages, Resources** out);
  static void destroy(Resources* resources);

  engine::Device& device() const { return device_; }
  /// Of the host's shaders, and ours, that bind the sets of alpenglow/view.h.
  VkShaderStageFlags setStages() const { return setStages_; }
  VkDescriptorSetLayout tableLayout() const { return tableLayout_; }
  VkDescriptorSetLayout inputLayout() const { return inputLayout_; }
  VkDescriptorSetLayout outputLayout() const { return outputLayout_; }
  VkPipelineLayout pipelineLayout() const { return pipelineLayout_; }
  VkSampler sampler() const { return sampler_; }
  /// For images that are read with texelFetch: their format need not filter.
  VkSampler nearestSampler() const { return nearestSampler_; }

  static const VkDescriptorSetLayoutBinding* tableLayoutBindings();
  static const VkDescriptorSetLayoutBinding* inputLayoutBindings();
  static const VkDescriptorSetLayoutBinding* outputLayoutBindings();

  /// The pipeline of a stage; made at the first call for its shader and constants, and kept.
  Status pipeline(const Stage& stage, VkPipeline* out);

  /// A new id for tables: unlike an address it is never reused.
  uint64_t nextTablesId() { return ++tablesMade_; }
  Context* context = nullptr;  ///< The owner.

 private:
  Resources(engine::Device& device, VkShaderStageFlags setStages)
      : device_(device),
        setStages_(setStages | VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT) {}
  Status makeLayouts();

  struct Key {
    const uint32_t* code = nullptr;
    uint64_t replacement = 0;  ///< Of the host's code in its place; 0: none.
    std::array<bool, kStageConstants> constants = {};
    EffectFlags disabledEffects = 0;
    auto operator<=>(const Key&) const = default;
  };

  engine::Device& device_;
  VkShaderStageFlags setStages_;
  std::atomic<uint64_t> tablesMade_{0};
  VkDescriptorSetLayout tableLayout_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout inputLayout_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout outputLayout_ = VK_NULL_HANDLE;
  VkPipelineLayout pipelineLayout_ = VK_NULL_HANDLE;
  VkSampler sampler_ = VK_NULL_HANDLE, nearestSampler_ = VK_NULL_HANDLE;
  std::mutex mutex_;
  std::map<Key, VkPipeline> pipelines_;
};

}  // namespace alpenglow::tables
