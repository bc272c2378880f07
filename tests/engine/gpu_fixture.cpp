#include "tests/engine/gpu_fixture.h"

#include <cmath>

namespace alpenglow::testing {

using namespace engine;

void GpuTest::SetUp() {
  DeviceTest::SetUp();
  ASSERT_FALSE(HasFatalFailure());
  ASSERT_EQ(engine::Device::create(deviceDesc(contextDesc()), &engineDevice_), Status::Ok)
      << lastDiagnostic();
}

void GpuTest::TearDown() {
  if (engineDevice_ != nullptr) {
    for (const Object& object : objects_) engineDevice_->destroyObject(object.type, object.handle);
    for (const auto& owned : images_) {
      destroyImage(*engineDevice_, &owned->image);
      freeBlock(*engineDevice_, &owned->block);
    }
    readback_ = {};
    engine::Device::destroy(engineDevice_);
  }
  DeviceTest::TearDown();
}

engine::Image& GpuTest::makeImage(uint32_t width, uint32_t height, VkFormat format,
                                  const char* name) {
  OwnedImage& owned = *images_.emplace_back(std::make_unique<OwnedImage>());
  ImageDesc desc;
  desc.format = format;
  desc.extent = {width, height, 1};
  const bool depth = formatAspects(format) != VK_IMAGE_ASPECT_COLOR_BIT;
  desc.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  desc.usage |= depth ? VkImageUsageFlags{VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT}
                      : VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  desc.name = name;
  EXPECT_EQ(createImage(*engineDevice_, desc, &owned.image), Status::Ok) << lastDiagnostic();
  engine::Image* pointer = &owned.image;
  EXPECT_EQ(allocateAndBind(*engineDevice_, name, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, &pointer, 1,
                            nullptr, 0, &owned.block),
            Status::Ok)
      << lastDiagnostic();
  return owned.image;
}

ComputePass GpuTest::makePass(const Shader& shader, const std::vector<engine::Image*>& images,
                              const std::vector<SpecConstant>& constants) {
  ComputePass pass;
  std::vector<VkDescriptorSetLayoutBinding> bindings(images.size());
  for (uint32_t i = 0; i < images.size(); ++i) {
    bindings[i] = {i, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr};
  }
  const auto count = static_cast<uint32_t>(bindings.size());
  EXPECT_EQ(createSetLayout(*engineDevice_, bindings.data(), count, "set", &pass.setLayout),
            Status::Ok);
  const PoolPart part = {bindings.data(), count, 1};
  EXPECT_EQ(createPool(*engineDevice_, &part, 1, "pool", &pass.pool), Status::Ok);
  EXPECT_EQ(allocateSets(*engineDevice_, pass.pool, &pass.setLayout, 1, "set", &pass.set),
            Status::Ok);
  DescriptorWriter writer(pass.set);
  for (uint32_t i = 0; i < images.size(); ++i) writer.storageImage(i, images[i]->view);
  EXPECT_EQ(writer.flush(*engineDevice_), Status::Ok);
  const VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(float)};
  EXPECT_EQ(
      createPipelineLayout(*engineDevice_, &pass.setLayout, 1, &range, 1, "layout", &pass.layout),
      Status::Ok);
  ComputePipelineDesc desc;
  desc.shader = shader;
  desc.layout = pass.layout;
  desc.constants = constants.data();
  desc.constantCount = static_cast<uint32_t>(constants.size());
  EXPECT_EQ(createComputePipeline(*engineDevice_, desc, &pass.pipeline), Status::Ok)
      << lastDiagnostic();
  keep(VK_OBJECT_TYPE_PIPELINE, handleNumber(pass.pipeline));
  keep(VK_OBJECT_TYPE_PIPELINE_LAYOUT, handleNumber(pass.layout));
  keep(VK_OBJECT_TYPE_DESCRIPTOR_POOL, handleNumber(pass.pool));
  keep(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, handleNumber(pass.setLayout));
  return pass;
}

void GpuTest::dispatch(VkCommandBuffer commandBuffer, const ComputePass& pass,
                       const engine::Image& over, float push) {
  vk().CmdBindPipeline(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pass.pipeline);
  vk().CmdBindDescriptorSets(commandBuffer, VK_PIPELINE_BIND_POINT_COMPUTE, pass.layout, 0, 1,
                             &pass.set, 0, nullptr);
  vk().CmdPushConstants(commandBuffer, pass.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(push),
                        &push);
  const VkExtent3D& extent = over.desc.extent;
  vk().CmdDispatch(commandBuffer, (extent.width + 7) / 8, (extent.height + 7) / 8, 1);
}

void GpuTest::copyBack(VkCommandBuffer commandBuffer, engine::Image& image, uint32_t texelBytes) {
  const VkExtent3D& extent = image.desc.extent;
  std::string error;
  readback_ = device().createHostBuffer(VkDeviceSize{extent.width} * extent.height * texelBytes,
                                        VK_BUFFER_USAGE_TRANSFER_DST_BIT, &error);
  ASSERT_NE(readback_.data(), nullptr) << error;
  Barriers barriers;
  barriers.image(image, kTransferSource);
  ASSERT_EQ(barriers.record(*engineDevice_, commandBuffer), Status::Ok);
  VkBufferImageCopy region = {};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = extent;
  vk().CmdCopyImageToBuffer(commandBuffer, image.handle, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                            readback_.buffer(), 1, &region);
  barriers.memory(VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                  VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
  ASSERT_EQ(barriers.record(*engineDevice_, commandBuffer), Status::Ok);
}

engine::FeatureSet featureSet(const Requirements& requirements) {
  return {requirements.apiVersion, (requirements.deviceFeatures & kFeatureSynchronization2) != 0,
          (requirements.deviceFeatures & kFeatureDynamicRendering) != 0, requirements.features};
}

engine::DeviceDesc deviceDesc(const ContextDesc& desc) {
  engine::DeviceDesc device;
  device.instance = desc.instance;
  device.physicalDevice = desc.physicalDevice;
  device.device = desc.device;
  device.getInstanceProcAddr = desc.getInstanceProcAddr;
  device.enabled = featureSet(desc.enabled);
  device.queueFamilies = desc.queueFamilies;
  device.queueFamilyCount = desc.queueFamilyCount;
  device.diagnostic = desc.diagnostics.report;
  device.user = desc.diagnostics.user;
  device.debugNames = desc.debugNames;
  return device;
}

float halfToFloat(uint16_t half) {
  const int exponent = half >> 10 & 31;
  const int mantissa = half & 1023;
  const float magnitude = exponent == 0
                              ? std::ldexp(static_cast<float>(mantissa), -24)
                              : std::ldexp(static_cast<float>(mantissa + 1024), exponent - 25);
  return (half & 0x8000) != 0 ? -magnitude : magnitude;
}

}  // namespace alpenglow::testing
