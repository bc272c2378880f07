// Engine objects on the validated device: a storage image that a shader fills, and its way back.
#pragma once

#include <cstring>
#include <vector>

#include "engine/barriers.h"
#include "engine/descriptors.h"
#include "engine/memory.h"
#include "engine/pipeline.h"
#include "tests/engine/device_fixture.h"

namespace alpenglow::testing {

/// A compute shader over storage images, bound one after the other from binding 0.
struct ComputePass {
  VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  VkDescriptorSet set = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
};

/// Destroys what it makes after each test.
class GpuTest : public DeviceTest {
 protected:
  void SetUp() override;
  void TearDown() override;

  engine::Device& engineDevice() { return *engineDevice_; }
  const engine::Dispatch& vk() { return engineDevice_->vk(); }

  /// Two-dimensional, with memory of its own, for every use that a test has.
  engine::Image& makeImage(uint32_t width, uint32_t height, VkFormat format, const char* name);
  ComputePass makePass(const engine::Shader& shader, const std::vector<engine::Image*>& images,
                       const std::vector<engine::SpecConstant>& constants = {});
  /// Binds, pushes one float and dispatches groups of 8x8 over the image.
  void dispatch(VkCommandBuffer commandBuffer, const ComputePass& pass, const engine::Image& over,
                float push = 0.0f);
  /// Records a copy of the image, of which one texel has `texelBytes`, to the readback buffer.
  void copyBack(VkCommandBuffer commandBuffer, engine::Image& image, uint32_t texelBytes);
  template <class T>
  std::vector<T> readback(size_t count) {
    std::vector<T> values(count);
    std::memcpy(values.data(), readback_.data(), count * sizeof(T));
    return values;
  }
  /// Destroyed after the test.
  void keep(VkObjectType type, uint64_t handle) { objects_.push_back({type, handle}); }

 private:
  struct Object {
    VkObjectType type;
    uint64_t handle;
  };
  struct OwnedImage {
    engine::Image image;
    engine::MemoryBlock block;
  };
  engine::Device* engineDevice_ = nullptr;
  std::vector<Object> objects_;
  std::vector<std::unique_ptr<OwnedImage>> images_;
  headless::HostBuffer readback_;
};

/// The same device as the engine is told of it.
engine::FeatureSet featureSet(const Requirements& requirements);
engine::DeviceDesc deviceDesc(const ContextDesc& desc);

/// The value of a half float.
float halfToFloat(uint16_t half);

}  // namespace alpenglow::testing
