#include "engine/device.h"

#include <gtest/gtest.h>

#include <thread>

#include "engine/descriptors.h"
#include "engine/image.h"
#include "engine/memory.h"
#include "engine/pipeline.h"
#include "tests/engine/mock_vulkan.h"

namespace alpenglow::engine {
namespace {

using testing::MockVulkan;

constexpr uint32_t kSpirv[] = {0x07230203, 0x00010500, 0, 1, 0};
constexpr Shader kShader = {kSpirv, sizeof(kSpirv), "shader"};

class DeviceCreationTest : public ::testing::Test {
 protected:
  void refused(const DeviceDesc& desc, Status expected, const std::string& part) {
    Device* device = handleFrom<Device*>(1);
    EXPECT_EQ(Device::create(desc, &device), expected);
    EXPECT_EQ(device, nullptr);
    ASSERT_EQ(mock_.diagnostics.size(), 1u);
    EXPECT_NE(mock_.lastDiagnostic().find(part), std::string::npos) << mock_.lastDiagnostic();
    EXPECT_EQ(mock_.lastDiagnostic().back(), '.');
    EXPECT_EQ(mock_.diagnosticValues[0].status, expected);
    EXPECT_EQ(mock_.diagnosticValues[0].severity, Severity::Error);
  }
  MockVulkan mock_;
};

TEST_F(DeviceCreationTest, GoodDescriptionIsAccepted) {
  Device* device = mock_.makeDevice();
  ASSERT_NE(device, nullptr);
  EXPECT_EQ(device->handle(), handleFrom<VkDevice>(3));
  EXPECT_EQ(device->sharingMode(), VK_SHARING_MODE_EXCLUSIVE);
  Device::destroy(device);
  EXPECT_TRUE(mock_.diagnostics.empty());
  Device::destroy(nullptr);
}

TEST_F(DeviceCreationTest, NullInstance) {
  DeviceDesc desc = mock_.deviceDesc();
  desc.instance = VK_NULL_HANDLE;
  refused(desc, Status::InvalidArgument, "ContextDesc::instance is null");
}

TEST_F(DeviceCreationTest, NullPhysicalDevice) {
  DeviceDesc desc = mock_.deviceDesc();
  desc.physicalDevice = VK_NULL_HANDLE;
  refused(desc, Status::InvalidArgument, "ContextDesc::physicalDevice is null");
}

TEST_F(DeviceCreationTest, NullDevice) {
  DeviceDesc desc = mock_.deviceDesc();
  desc.device = VK_NULL_HANDLE;
  refused(desc, Status::InvalidArgument, "ContextDesc::device is null");
}

TEST_F(DeviceCreationTest, NullGetInstanceProcAddr) {
  DeviceDesc desc = mock_.deviceDesc();
  desc.getInstanceProcAddr = nullptr;
  refused(desc, Status::InvalidArgument, "ContextDesc::getInstanceProcAddr is null");
}

TEST_F(DeviceCreationTest, QueueFamiliesWithoutArray) {
  DeviceDesc desc = mock_.deviceDesc();
  desc.queueFamilyCount = 2;
  refused(desc, Status::InvalidArgument, "queueFamilyCount is 2");
}

TEST_F(DeviceCreationTest, RepeatedQueueFamily) {
  const uint32_t families[] = {4, 1, 4};
  DeviceDesc desc = mock_.deviceDesc();
  desc.queueFamilies = families;
  desc.queueFamilyCount = 3;
  refused(desc, Status::InvalidArgument, "family 4 twice");
}

TEST_F(DeviceCreationTest, HalfOfTheHooks) {
  MemoryHooks hooks;
  hooks.free = [](void*, const MemoryRange&) {};
  DeviceDesc desc = mock_.deviceDesc();
  desc.memory = &hooks;
  refused(desc, Status::InvalidArgument, "lacks its function allocate");
}

TEST_F(DeviceCreationTest, OldApiAndNoSynchronizationAreListedTogether) {
  DeviceDesc desc = mock_.deviceDesc();
  desc.enabled.apiVersion = VK_API_VERSION_1_2;
  desc.enabled.synchronization2 = false;
  refused(desc, Status::Unsupported, "Vulkan 1.3 (it is 1.2), synchronization2.");
}

TEST_F(DeviceCreationTest, OldDevice) {
  mock_.properties.apiVersion = VK_API_VERSION_1_1;
  refused(mock_.deviceDesc(), Status::Unsupported,
          "The device \"mock\" has Vulkan 1.1, but 1.3 or later is needed.");
}

TEST_F(DeviceCreationTest, MissingFunctionsAreNamed) {
  for (const char* name : {"vkGetDeviceProcAddr", "vkCmdPipelineBarrier2", "vkCreateImage"}) {
    mock_.missingFunction = name;
    mock_.diagnostics.clear();
    mock_.diagnosticValues.clear();
    refused(mock_.deviceDesc(), Status::Unsupported, name);
  }
}

TEST_F(DeviceCreationTest, NoDiagnosticCallbackIsFine) {
  DeviceDesc desc = mock_.deviceDesc();
  desc.diagnostic = nullptr;
  desc.device = VK_NULL_HANDLE;
  Device* device = nullptr;
  EXPECT_EQ(Device::create(desc, &device), Status::InvalidArgument);
}

TEST_F(DeviceCreationTest, DebugNamesAreLoadedOnlyOnRequest) {
  EXPECT_EQ(mock_.table().SetDebugUtilsObjectNameEXT, nullptr);
  Dispatch table;
  const DeviceDesc desc = mock_.deviceDesc();
  EXPECT_TRUE(table.load(desc.getInstanceProcAddr, desc.instance, desc.device, true, nullptr));
  EXPECT_NE(table.SetDebugUtilsObjectNameEXT, nullptr);
}

class EngineDeviceTest : public ::testing::Test {
 protected:
  void SetUp() override { device_ = mock_.makeDevice(); }
  void TearDown() override {
    Device::destroy(device_);
    EXPECT_TRUE(mock_.alive.empty());
    for (const std::string& mistake : mock_.mistakes) ADD_FAILURE() << mistake;
  }
  Image makeImage() {
    ImageDesc desc;
    desc.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    desc.extent = {4, 4, 1};
    desc.usage = VK_IMAGE_USAGE_STORAGE_BIT;
    desc.name = "table";
    Image image;
    EXPECT_EQ(createImage(*device_, desc, &image), Status::Ok);
    return image;
  }
  MemoryBlock bind(Image* image) {
    MemoryBlock block;
    EXPECT_EQ(allocateAndBind(*device_, "block", VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, &image, 1,
                              nullptr, 0, &block),
              Status::Ok);
    return block;
  }

  MockVulkan mock_;
  Device* device_ = nullptr;
};

TEST_F(EngineDeviceTest, ResultsBecomeStatusesAndSentences) {
  EXPECT_EQ(device_->failVk(VK_SUCCESS, "vkX"), Status::Ok);
  EXPECT_EQ(device_->failVk(VK_PIPELINE_COMPILE_REQUIRED, "vkX"), Status::Ok);
  EXPECT_TRUE(mock_.diagnostics.empty());
  EXPECT_EQ(device_->failVk(VK_ERROR_OUT_OF_HOST_MEMORY, "vkX"), Status::OutOfHostMemory);
  EXPECT_EQ(device_->failVk(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkX"), Status::OutOfDeviceMemory);
  EXPECT_EQ(device_->failVk(VK_ERROR_DEVICE_LOST, "vkX"), Status::DeviceLost);
  EXPECT_EQ(device_->failVk(VK_ERROR_TOO_MANY_OBJECTS, "vkX"), Status::OutOfDeviceMemory);
  EXPECT_EQ(device_->failVk(VK_ERROR_UNKNOWN, "vkX"), Status::VulkanError);
  EXPECT_EQ(mock_.diagnosticValues.back().result, VK_ERROR_UNKNOWN);
  EXPECT_EQ(device_->failVk(VK_ERROR_OUT_OF_DEVICE_MEMORY, "vkCreateImage", "image", "T"),
            Status::OutOfDeviceMemory);
  EXPECT_EQ(mock_.lastDiagnostic(),
            "vkCreateImage for image \"T\" returned VK_ERROR_OUT_OF_DEVICE_MEMORY (-2).");
}

TEST_F(EngineDeviceTest, LongSentencesAreCutNotOverrun) {
  const std::string text(5000, 'x');
  EXPECT_EQ(device_->fail(Status::VulkanError, VK_SUCCESS, "%s", text.c_str()),
            Status::VulkanError);
  EXPECT_EQ(mock_.lastDiagnostic().size(), 1023u);
}

TEST_F(EngineDeviceTest, CountersFollowWhatIsAlive) {
  Image first = makeImage();
  MemoryBlock block = bind(&first);
  Image second = makeImage();
  const Counters& report = device_->counters();
  EXPECT_EQ(report.images.load(), 2u);
  EXPECT_EQ(report.bytes.load(), 1000u);
  destroyImage(*device_, &second);
  destroyImage(*device_, &first);
  freeBlock(*device_, &block);
  EXPECT_EQ(report.images.load(), 0u);
  EXPECT_EQ(report.bytes.load(), 0u);
  EXPECT_EQ(report.peakBytes.load(), 1000u);
}

TEST_F(EngineDeviceTest, LeftoversAreReportedAtTheEnd) {
  makeImage();
  Device::destroy(device_);
  device_ = nullptr;
  EXPECT_EQ(
      mock_.lastDiagnostic(),
      "The context is destroyed while 1 images, 0 buffers and 0 bytes of it are still alive.");
  EXPECT_EQ(mock_.diagnosticValues.back().severity, Severity::Warning);
  mock_.alive.clear();
}

TEST_F(EngineDeviceTest, DeletionWaitsForItsFrame) {
  Image image = makeImage();
  MemoryBlock block = bind(&image);
  deferImage(*device_, 7, &image);
  deferBlock(*device_, 7, &block);
  EXPECT_EQ(image.handle, handleFrom<VkImage>(0));
  EXPECT_EQ(block.size, 0u);
  EXPECT_EQ(device_->deletions().size(), 3u);
  device_->deletions().collect(6);
  EXPECT_TRUE(mock_.destroyed.empty());
  EXPECT_EQ(device_->counters().images, 1u);
  device_->deletions().collect(7);
  EXPECT_EQ(mock_.destroyed, (std::vector<std::string>{"ImageView", "Image", "DeviceMemory"}));
  EXPECT_EQ(device_->counters().images, 0u);
  EXPECT_EQ(device_->counters().bytes, 0u);
  device_->deletions().collect(100);
  EXPECT_EQ(mock_.destroyed.size(), 3u);
}

TEST_F(EngineDeviceTest, FramesOfDifferentViewsMayInterleave) {
  VkPipelineLayout layouts[3] = {};
  const uint64_t frames[] = {9, 2, 5};
  for (int i = 0; i < 3; ++i) {
    ASSERT_EQ(createPipelineLayout(*device_, nullptr, 0, nullptr, 0, "layout", &layouts[i]),
              Status::Ok);
    device_->deletions().defer(frames[i], VK_OBJECT_TYPE_PIPELINE_LAYOUT, handleNumber(layouts[i]));
  }
  device_->deletions().collect(5);
  EXPECT_EQ(device_->deletions().size(), 1u);
  EXPECT_EQ(mock_.alive.count(handleNumber(layouts[0])), 1u);
  device_->deletions().destroyAll();
  EXPECT_EQ(device_->deletions().size(), 0u);
}

TEST_F(EngineDeviceTest, NullsAreNotDeferred) {
  device_->deletions().defer(1, VK_OBJECT_TYPE_IMAGE, 0);
  device_->deletions().defer(1, MemoryBlock{});
  EXPECT_EQ(device_->deletions().size(), 0u);
}

TEST_F(EngineDeviceTest, UnknownTypesAreRefusedAloud) {
  device_->destroyObject(VK_OBJECT_TYPE_FENCE, uint64_t{12});
  EXPECT_NE(mock_.lastDiagnostic().find("VkObjectType 7"), std::string::npos);
}

TEST_F(EngineDeviceTest, DestroyCollectsWhatStillWaits) {
  Image image = makeImage();
  MemoryBlock block = bind(&image);
  deferImage(*device_, UINT64_MAX, &image);
  deferBlock(*device_, UINT64_MAX, &block);
  Device::destroy(device_);
  device_ = nullptr;
  EXPECT_TRUE(mock_.alive.empty());
  EXPECT_TRUE(mock_.diagnostics.empty());
}

TEST_F(EngineDeviceTest, DeletionQueueTakesSeveralThreads) {
  std::vector<VkSampler> samplers(400);
  for (VkSampler& sampler : samplers) {
    sampler = handleFrom<VkSampler>(mock_.make("Sampler", nullptr));
  }
  const auto defer = [&](size_t begin) {
    for (size_t i = begin; i < samplers.size(); i += 2) {
      device_->deletions().defer(i, VK_OBJECT_TYPE_SAMPLER, handleNumber(samplers[i]));
    }
  };
  std::thread other(defer, 1);
  defer(0);
  other.join();
  EXPECT_EQ(device_->deletions().size(), samplers.size());
  device_->deletions().collect(399);
  EXPECT_EQ(mock_.aliveCount("Sampler"), 0);
}

TEST_F(EngineDeviceTest, EqualShadersCountAsOneVariant) {
  ComputePipelineDesc desc;
  desc.shader = kShader;
  const SpecConstant one = specUint(0, 1);
  const SpecConstant two = specUint(0, 2);
  std::vector<VkPipeline> pipelines;
  for (const SpecConstant* constant : {&one, &one, &two}) {
    desc.constants = constant;
    desc.constantCount = 1;
    ASSERT_EQ(createComputePipeline(*device_, desc, &pipelines.emplace_back()), Status::Ok);
  }
  EXPECT_EQ(device_->counters().pipelines, 3u);
  EXPECT_EQ(device_->counters().shaderVariants, 2u);
  EXPECT_EQ(mock_.aliveCount("ShaderModule"), 0);
  for (VkPipeline pipeline : pipelines) {
    device_->destroyObject(VK_OBJECT_TYPE_PIPELINE, pipeline);
  }
  EXPECT_EQ(device_->counters().pipelines, 3u);
}

TEST_F(EngineDeviceTest, WrongShaderCodeIsRefused) {
  const uint32_t wrongMagic[] = {1, 2, 3, 4, 5};
  ComputePipelineDesc desc;
  VkPipeline pipeline = VK_NULL_HANDLE;
  for (const Shader& shader : {Shader{}, Shader{kSpirv, 18, "cut"}, Shader{kSpirv, 8, "short"},
                               Shader{wrongMagic, sizeof(wrongMagic), "text"}}) {
    desc.shader = shader;
    EXPECT_EQ(createComputePipeline(*device_, desc, &pipeline), Status::InvalidArgument);
    EXPECT_NE(mock_.lastDiagnostic().find("SPIR-V"), std::string::npos);
  }
  EXPECT_EQ(mock_.count("vkCreateShaderModule"), 0);
}

TEST_F(EngineDeviceTest, TooManyConstantsAreRefused) {
  const std::vector<SpecConstant> constants(kMaxSpecConstants + 1);
  ComputePipelineDesc desc;
  desc.shader = kShader;
  desc.constants = constants.data();
  desc.constantCount = kMaxSpecConstants + 1;
  VkPipeline pipeline = VK_NULL_HANDLE;
  EXPECT_EQ(createComputePipeline(*device_, desc, &pipeline), Status::InvalidArgument);
  EXPECT_NE(mock_.lastDiagnostic().find("33 specialization constants"), std::string::npos);
}

TEST_F(EngineDeviceTest, DynamicRenderingMustBeEnabled) {
  Device::destroy(device_);
  DeviceDesc deviceDesc = mock_.deviceDesc();
  deviceDesc.enabled.dynamicRendering = false;
  ASSERT_EQ(Device::create(deviceDesc, &device_), Status::Ok);
  GraphicsPipelineDesc desc;
  desc.vertex = kShader;
  desc.fragment = kShader;
  desc.colors[0].format = VK_FORMAT_R8G8B8A8_UNORM;
  VkPipeline pipeline = VK_NULL_HANDLE;
  EXPECT_EQ(createGraphicsPipeline(*device_, desc, &pipeline), Status::Unsupported);
  desc.renderPass = handleFrom<VkRenderPass>(8);
  EXPECT_EQ(createGraphicsPipeline(*device_, desc, &pipeline), Status::Ok);
  device_->destroyObject(VK_OBJECT_TYPE_PIPELINE, pipeline);
  desc.viewMask = 3;
  EXPECT_EQ(createGraphicsPipeline(*device_, desc, &pipeline), Status::InvalidArgument);
}

TEST_F(EngineDeviceTest, PushConstantsBeyondTheLimitAreRefused) {
  const VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 64, 68};
  VkPipelineLayout layout = VK_NULL_HANDLE;
  EXPECT_EQ(createPipelineLayout(*device_, nullptr, 0, &range, 1, "wide", &layout),
            Status::Unsupported);
  EXPECT_EQ(mock_.lastDiagnostic(),
            "Pipeline layout \"wide\" has push constants up to byte 132, but the device allows 128 "
            "bytes.");
}

TEST_F(EngineDeviceTest, ImagesAreCheckedBeforeVulkanIsCalled) {
  ImageDesc good;
  good.format = VK_FORMAT_R32G32B32A32_SFLOAT;
  good.extent = {16, 16, 1};
  good.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  good.name = "S";
  ASSERT_EQ(checkImage(*device_, good), Status::Ok);

  const auto refused = [&](const ImageDesc& desc, Status expected, const char* part) {
    Image image;
    EXPECT_EQ(createImage(*device_, desc, &image), expected);
    EXPECT_NE(mock_.lastDiagnostic().find(part), std::string::npos) << mock_.lastDiagnostic();
    EXPECT_EQ(image.handle, handleFrom<VkImage>(0));
  };
  ImageDesc desc = good;
  desc.extent.height = 0;
  refused(desc, Status::InvalidArgument, "none may be 0");
  desc = good;
  desc.mipLevels = 6;
  refused(desc, Status::InvalidArgument, "at most 5");
  desc = good;
  desc.extent.width = 20000;
  refused(desc, Status::Unsupported, "20000x16x1");
  mock_.formatFeatures = ~VkFormatFeatureFlags{VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT};
  refused(good, Status::Unsupported, "linear filtering of VkFormat 109");
  desc = good;
  desc.linearFilter = false;
  EXPECT_EQ(checkImage(*device_, desc), Status::Ok);
  mock_.formatFeatures = ~VkFormatFeatureFlags{VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT};
  refused(good, Status::Unsupported, "storage images");
  EXPECT_EQ(mock_.count("vkCreateImage"), 0);
}

TEST_F(EngineDeviceTest, ImagesAreMadeAsDescribed) {
  ImageDesc desc;
  desc.type = VK_IMAGE_TYPE_2D;
  desc.format = VK_FORMAT_R16G16_SFLOAT;
  desc.extent = {64, 32, 1};
  desc.mipLevels = 4;
  desc.arrayLayers = 6;
  desc.usage = VK_IMAGE_USAGE_SAMPLED_BIT;
  desc.name = "a name that is longer than the forty-eight bytes that an image keeps";
  Image image;
  ASSERT_EQ(createImage(*device_, desc, &image), Status::Ok);
  const VkImageCreateInfo& info = mock_.imageInfos.back();
  EXPECT_EQ(info.imageType, desc.type);
  EXPECT_EQ(info.format, desc.format);
  EXPECT_EQ(info.extent.height, 32u);
  EXPECT_EQ(info.mipLevels, 4u);
  EXPECT_EQ(info.arrayLayers, 6u);
  EXPECT_EQ(info.usage, desc.usage);
  EXPECT_EQ(info.tiling, VK_IMAGE_TILING_OPTIMAL);
  EXPECT_EQ(info.initialLayout, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_EQ(std::string(image.name).size(), 47u);
  EXPECT_EQ(image.state.layout, VK_IMAGE_LAYOUT_UNDEFINED);
  destroyImage(*device_, &image);
}

TEST_F(EngineDeviceTest, TwoQueueFamiliesMakeImagesConcurrent) {
  Image exclusive = makeImage();
  EXPECT_EQ(mock_.imageInfos.back().sharingMode, VK_SHARING_MODE_EXCLUSIVE);
  destroyImage(*device_, &exclusive);
  Device::destroy(device_);
  const uint32_t families[] = {0, 2};
  DeviceDesc desc = mock_.deviceDesc();
  desc.queueFamilies = families;
  desc.queueFamilyCount = 2;
  ASSERT_EQ(Device::create(desc, &device_), Status::Ok);
  Image concurrent = makeImage();
  EXPECT_EQ(mock_.imageInfos.back().sharingMode, VK_SHARING_MODE_CONCURRENT);
  EXPECT_EQ(mock_.imageInfos.back().queueFamilyIndexCount, 2u);
  destroyImage(*device_, &concurrent);
}

TEST_F(EngineDeviceTest, PoolHoldsExactlyWhatItIsMadeFor) {
  const VkDescriptorSetLayoutBinding first[] = {
      {0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1, VK_SHADER_STAGE_ALL, nullptr},
      {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 3, VK_SHADER_STAGE_ALL, nullptr}};
  const VkDescriptorSetLayoutBinding second[] = {
      {0, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_ALL, nullptr},
      {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_ALL, nullptr}};
  const PoolPart parts[] = {{first, 2, 2}, {second, 2, 5}};
  VkDescriptorPool pool = VK_NULL_HANDLE;
  ASSERT_EQ(createPool(*device_, parts, 2, "pool", &pool), Status::Ok);
  EXPECT_EQ(mock_.poolSets, 7u);
  ASSERT_EQ(mock_.poolSizes.size(), 3u);
  EXPECT_EQ(mock_.poolSizes[0].descriptorCount, 2u);
  EXPECT_EQ(mock_.poolSizes[1].type, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
  EXPECT_EQ(mock_.poolSizes[1].descriptorCount, 11u);
  EXPECT_EQ(mock_.poolSizes[2].descriptorCount, 5u);
  device_->destroyObject(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool);
  EXPECT_EQ(createPool(*device_, parts, 0, "none", &pool), Status::InvalidArgument);
}

TEST_F(EngineDeviceTest, DescriptorWriterSendsOnceAndRefusesTooMany) {
  DescriptorWriter writer(handleFrom<VkDescriptorSet>(5));
  writer.storageImage(0, handleFrom<VkImageView>(6))
      .sampledImage(2, handleFrom<VkImageView>(7), handleFrom<VkSampler>(8));
  EXPECT_EQ(writer.flush(*device_), Status::Ok);
  ASSERT_EQ(mock_.descriptorWrites.size(), 2u);
  EXPECT_EQ(mock_.descriptorWrites[0].pImageInfo->imageLayout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(mock_.descriptorWrites[1].dstBinding, 2u);
  EXPECT_EQ(mock_.descriptorWrites[1].pImageInfo->sampler, handleFrom<VkSampler>(8));
  EXPECT_EQ(writer.flush(*device_), Status::Ok);
  EXPECT_EQ(mock_.count("vkUpdateDescriptorSets"), 1);

  for (uint32_t i = 0; i <= DescriptorWriter::kCapacity; ++i) {
    writer.uniformBuffer(i, handleFrom<VkBuffer>(9));
  }
  EXPECT_EQ(writer.flush(*device_), Status::InvalidArgument);
  EXPECT_EQ(mock_.count("vkUpdateDescriptorSets"), 1);
}

}  // namespace
}  // namespace alpenglow::engine
