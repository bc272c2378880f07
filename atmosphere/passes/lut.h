// What the LUTs of a view share: images that one dispatch fills from the tables, and the inputs
// that they were filled for.
#pragma once

#include "atmosphere/tables/table_set.h"
#include "engine/barriers.h"

namespace alpenglow::passes {

struct LutDesc {
  const char* name = "";
  VkImageType type = VK_IMAGE_TYPE_2D;
  VkExtent3D extent = {};
  uint32_t count = 1;     ///< Images.
  uint32_t bindings = 1;  ///< Storage images of set 1; the last image fills those beyond count.
  uint32_t constantBytes = 0;  ///< At most Lut::kMostConstants.
  TableFormat format = TableFormat::Half;
  VkPipelineStageFlags2 readers = 0;
};

/// Owned by a view; externally synchronised.
class Lut {
 public:
  static constexpr uint32_t kMostImages = 3, kMostConstants = 32;

  explicit Lut(tables::Resources& resources) : resources_(resources), device_(resources.device()) {}
  Lut(const Lut&) = delete;
  Lut& operator=(const Lut&) = delete;

  Status make(const LutDesc& desc, const engine::Shader& shader,
              const engine::SpecConstant* constants, uint32_t constantCount);
  void destroy(uint64_t frame);
  engine::Device& device() const { return device_; }
  bool made() const { return pipeline_ != VK_NULL_HANDLE; }

  /// Whether the images were filled from these tables with these constants.
  bool current(const Tables& tables, const void* constants) const;
  /// Fills the images unless they are current, and leaves them readable.
  Status record(VkCommandBuffer commands, const Tables& tables, const void* constants,
                uint32_t groupsX, uint32_t groupsY);
  /// Commands of that frame never execute.
  void abandon(uint64_t frame);

  const engine::Image& image(uint32_t i) const { return images_[i < count_ ? i : count_ - 1]; }
  uint32_t count() const { return count_; }
  Status assertReadable() const;
  uint64_t bytes() const;  ///< Of its images.

 private:
  Status makeImages(const LutDesc& desc);
  Status makeSet(const LutDesc& desc);

  tables::Resources& resources_;
  engine::Device& device_;
  uint32_t count_ = 0;
  uint32_t constantBytes_ = 0;
  engine::ImageState readable_;
  engine::Image images_[kMostImages];
  engine::MemoryBlock block_;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  uint64_t tablesId_ = 0;  ///< 0: the images hold nothing.
  uint64_t frame_ = 0;     ///< The frame in which they were recorded.
  unsigned char constants_[kMostConstants] = {};
};

}  // namespace alpenglow::passes
