// What all tables of a context share: layouts, the sampler, and the pipelines of the passes.
#pragma once

#include <atomic>
#include <map>
#include <mutex>
#include <tuple>

#include "atmosphere/bake/pass.h"
#include "engine/descriptors.h"
#include "engine/pipeline.h"

namespace alpenglow::bake {

/// Push constants of every bake shader: shaders/glsl/bake/common.glsl.
struct TileConstants {
  uint32_t firstRow, endRow, width, height;
};

inline constexpr uint32_t kTableBindings = 5;  ///< Uniforms and four sampled tables.
inline constexpr uint32_t kInputBindings = 8;  ///< Uniforms and seven sampled images.

VkFormat vulkanFormat(TableFormat format);
/// Float where the device stores and filters it, else `otherwise`: for what differences are taken
/// of, or what must not round the tables.
TableFormat finestFormat(const engine::Device& device, TableFormat otherwise);

/// Made with the context, destroyed with it. Thread-safe.
class Resources {
 public:
  static Status create(engine::Device& device, Resources** out);
  static void destroy(Resources* resources);

  engine::Device& device() const { return device_; }
  VkDescriptorSetLayout tableLayout() const { return tableLayout_; }
  VkDescriptorSetLayout inputLayout() const { return inputLayout_; }
  VkDescriptorSetLayout outputLayout() const { return outputLayout_; }
  VkPipelineLayout pipelineLayout() const { return pipelineLayout_; }
  VkSampler sampler() const { return sampler_; }

  static const VkDescriptorSetLayoutBinding* tableLayoutBindings();
  static const VkDescriptorSetLayoutBinding* inputLayoutBindings();
  static const VkDescriptorSetLayoutBinding* outputLayoutBindings();

  /// The pipeline of a pass for tables of a format; made at the first call and kept.
  Status pipeline(PassKind kind, TableFormat format, bool firstOrder, MieStorage mie,
                  VkPipeline* out);

  /// Objects of the host that are alive on this context.
  std::atomic<uint32_t> liveTables{0}, liveViews{0};
  std::atomic<uint64_t> tablesMade{0};  ///< Numbers them: an address may come again, an id never.

 private:
  explicit Resources(engine::Device& device) : device_(device) {}
  Status makeLayouts();

  using Key = std::tuple<PassKind, TableFormat, bool, MieStorage>;

  engine::Device& device_;
  VkDescriptorSetLayout tableLayout_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout inputLayout_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout outputLayout_ = VK_NULL_HANDLE;
  VkPipelineLayout pipelineLayout_ = VK_NULL_HANDLE;
  VkSampler sampler_ = VK_NULL_HANDLE;
  std::mutex mutex_;
  std::map<Key, VkPipeline> pipelines_;
};

}  // namespace alpenglow::bake
