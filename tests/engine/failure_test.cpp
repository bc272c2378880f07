// Every call to Vulkan that can fail is made to fail, one after the other: the status is the
// documented one, a sentence comes with it, and nothing stays alive.
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/descriptors.h"
#include "engine/memory.h"
#include "engine/pipeline.h"
#include "engine/sampler.h"
#include "tests/engine/counting_allocator.h"
#include "tests/engine/mock_vulkan.h"

namespace alpenglow::engine {
namespace {

using testing::CountingAllocator;
using testing::MockVulkan;

constexpr uint32_t kSpirv[] = {0x07230203, 0x00010500, 0, 1, 0};
constexpr Shader kShader = {kSpirv, sizeof(kSpirv), "shader"};

constexpr VkDescriptorSetLayoutBinding kBinding = {0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1,
                                                   VK_SHADER_STAGE_COMPUTE_BIT, nullptr};

/// Makes some of everything; on any failure releases what there is and returns the status.
class Everything {
 public:
  explicit Everything(Device& device) : device_(device) {}
  ~Everything() {
    device_.destroyObject(VK_OBJECT_TYPE_PIPELINE, compute_);
    device_.destroyObject(VK_OBJECT_TYPE_PIPELINE, graphics_);
    device_.destroyObject(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout_);
    device_.destroyObject(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool_);
    device_.destroyObject(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, setLayout_);
    device_.destroyObject(VK_OBJECT_TYPE_SAMPLER, sampler_);
    for (Image& image : images_) destroyImage(device_, &image);
    for (Buffer& buffer : buffers_) destroyBuffer(device_, &buffer);
    freeBlock(device_, &block_);
  }

  Status make() {
    Status status = makeMemory();
    if (status == Status::Ok) status = makeDescriptors();
    if (status == Status::Ok) status = makePipelines();
    return status;
  }

 private:
  Status makeMemory() {
    for (Image& image : images_) {
      ImageDesc desc;
      desc.format = VK_FORMAT_R16G16B16A16_SFLOAT;
      desc.usage = VK_IMAGE_USAGE_STORAGE_BIT;
      desc.name = "image";
      if (Status status = createImage(device_, desc, &image); status != Status::Ok) return status;
    }
    for (Buffer& buffer : buffers_) {
      const Status status =
          createBuffer(device_, 64, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "buffer", &buffer);
      if (status != Status::Ok) return status;
    }
    Image* const images[] = {&images_[0], &images_[1]};
    Buffer* const buffers[] = {&buffers_[0], &buffers_[1]};
    return allocateAndBind(
        device_, "block",
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT, images, 2,
        buffers, 2, &block_);
  }

  Status makeDescriptors() {
    Status status = createSampler(device_, {}, &sampler_);
    if (status != Status::Ok) return status;
    status = createSetLayout(device_, &kBinding, 1, "layout", &setLayout_);
    if (status != Status::Ok) return status;
    const PoolPart part = {&kBinding, 1, 1};
    status = createPool(device_, &part, 1, "pool", &pool_);
    if (status != Status::Ok) return status;
    status = allocateSets(device_, pool_, &setLayout_, 1, "set", &set_);
    if (status != Status::Ok) {
      EXPECT_EQ(set_, handleFrom<VkDescriptorSet>(0));
    }
    return status;
  }

  Status makePipelines() {
    Status status = createPipelineLayout(device_, &setLayout_, 1, nullptr, 0, "layout", &layout_);
    if (status != Status::Ok) return status;
    ComputePipelineDesc compute;
    compute.shader = kShader;
    compute.layout = layout_;
    status = createComputePipeline(device_, compute, &compute_);
    if (status != Status::Ok) return status;
    GraphicsPipelineDesc graphics;
    graphics.vertex = kShader;
    graphics.geometry = kShader;
    graphics.fragment = kShader;
    graphics.layout = layout_;
    graphics.colors[0].format = VK_FORMAT_R8G8B8A8_UNORM;
    return createGraphicsPipeline(device_, graphics, &graphics_);
  }

  Device& device_;
  Image images_[2];
  Buffer buffers_[2];
  MemoryBlock block_;
  VkSampler sampler_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline compute_ = VK_NULL_HANDLE;
  VkPipeline graphics_ = VK_NULL_HANDLE;
};

struct Case {
  VkResult result;
  Status status;
};
class FailureTest : public ::testing::TestWithParam<Case> {};

TEST_P(FailureTest, NthCallFailsCleanly) {
  std::vector<std::string> failedCalls;
  bool succeeded = false;
  for (int n = 0; !succeeded && n < 100; ++n) {
    MockVulkan mock;
    CountingAllocator allocator;
    mock.allocator = allocator.callbacks();
    Device* device = mock.makeDevice();
    ASSERT_NE(device, nullptr);
    mock.failAt = mock.fallibleCalls + n;
    mock.failWith = GetParam().result;
    {
      Everything everything(*device);
      const Status status = everything.make();
      succeeded = status == Status::Ok;
      if (succeeded) {
        EXPECT_TRUE(mock.failedCall.empty()) << mock.failedCall << " failed unseen";
      } else {
        EXPECT_EQ(status, GetParam().status) << mock.failedCall;
        ASSERT_EQ(mock.diagnostics.size(), 1u) << mock.failedCall;
        EXPECT_NE(mock.lastDiagnostic().find(resultName(GetParam().result)), std::string::npos)
            << mock.lastDiagnostic();
        EXPECT_EQ(mock.diagnosticValues[0].result, GetParam().result);
        failedCalls.push_back(mock.failedCall);
      }
    }
    EXPECT_TRUE(mock.alive.empty()) << mock.failedCall << " left objects";
    EXPECT_TRUE(mock.mistakes.empty()) << mock.failedCall << ": " << mock.mistakes.front();
    EXPECT_EQ(allocator.alive, 0) << mock.failedCall;
    EXPECT_EQ(device->counters().bytes, 0u);
    EXPECT_EQ(device->counters().images, 0u);
    EXPECT_EQ(device->counters().buffers, 0u);
    if (!failedCalls.empty()) {
      EXPECT_EQ(mock.count("vkMapMemory") - (mock.failedCall == "vkMapMemory" ? 1 : 0),
                mock.count("vkUnmapMemory"));
    }
    Device::destroy(device);
  }
  EXPECT_TRUE(succeeded);
  // Each kind of call has had its turn; a new one in Dispatch belongs here too.
  for (const char* call :
       {"vkCreateImage", "vkCreateBuffer", "vkAllocateMemory", "vkMapMemory", "vkBindImageMemory",
        "vkBindBufferMemory", "vkCreateImageView", "vkCreateSampler", "vkCreateDescriptorSetLayout",
        "vkCreateDescriptorPool", "vkAllocateDescriptorSets", "vkCreatePipelineLayout",
        "vkCreateShaderModule", "vkCreateComputePipelines", "vkCreateGraphicsPipelines"}) {
    EXPECT_NE(std::find(failedCalls.begin(), failedCalls.end(), call), failedCalls.end()) << call;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Results, FailureTest,
    ::testing::Values(Case{VK_ERROR_OUT_OF_HOST_MEMORY, Status::OutOfHostMemory},
                      Case{VK_ERROR_OUT_OF_DEVICE_MEMORY, Status::OutOfDeviceMemory},
                      Case{VK_ERROR_DEVICE_LOST, Status::DeviceLost},
                      Case{VK_ERROR_UNKNOWN, Status::VulkanError}),
    [](const auto& test) { return std::string(resultName(test.param.result)); });

TEST(AllocationCallbacksTest, EveryObjectIsMadeAndDestroyedWithThem) {
  MockVulkan mock;
  CountingAllocator allocator;
  mock.allocator = allocator.callbacks();
  Device* device = mock.makeDevice();
  {
    Everything everything(*device);
    EXPECT_EQ(everything.make(), Status::Ok);
    EXPECT_GT(allocator.alive, 0);
  }
  EXPECT_EQ(allocator.alive, 0);
  EXPECT_GE(allocator.total, 13);
  EXPECT_TRUE(mock.mistakes.empty());
  Device::destroy(device);
}

}  // namespace
}  // namespace alpenglow::engine
