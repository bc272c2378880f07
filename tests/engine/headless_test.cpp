#include <alpenglow/headless.h>

#include <cctype>
#include <cstdlib>

#include "tests/engine/device_fixture.h"

namespace alpenglow::headless {
namespace {

using testing::DeviceTest;

/// Sets an environment variable for its lifetime.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value, 1);
  }
  ~Environment() {
    if (old_.empty()) {
      unsetenv(name_);
    } else {
      setenv(name_, old_.c_str(), 1);
    }
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::string old_;
};

std::unique_ptr<Device> makeSelected(const std::string& select, std::string* error) {
  DeviceOptions options;
  options.select = select;
  return Device::create(options, error);
}

TEST(HeadlessTest, ListsDevicesInIndexOrder) {
  std::string error;
  const std::vector<std::string> names = listDevices(&error);
  ASSERT_FALSE(names.empty()) << error;
  const std::unique_ptr<Device> device = makeSelected("0", &error);
  ASSERT_NE(device, nullptr) << error;
  EXPECT_EQ(device->name(), names[0]);
}

TEST(HeadlessTest, FindsADeviceByPartOfItsNameInAnyCase) {
  std::string error;
  std::string part = listDevices(&error).at(0).substr(1, 5);
  for (char& c : part) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  EXPECT_NE(makeSelected(part, &error), nullptr) << error;
}

TEST(HeadlessTest, UnknownNameOrIndexListsWhatExists) {
  std::string error;
  const std::string first = "0 \"" + listDevices(&error).at(0) + "\"";
  for (const char* select : {"no such card", "99", "99999999999999999999999999"}) {
    error.clear();
    EXPECT_EQ(makeSelected(select, &error), nullptr);
    EXPECT_NE(error.find(std::string("\"") + select + "\""), std::string::npos) << error;
    EXPECT_NE(error.find(first), std::string::npos) << error;
    EXPECT_EQ(error.back(), '.');
  }
}

TEST(HeadlessTest, NoDriverIsOneClearSentence) {
  const Environment environment("VK_DRIVER_FILES", "/nowhere/driver.json");
  std::string error;
  EXPECT_EQ(makeSelected("", &error), nullptr);
  EXPECT_EQ(error.find("No Vulkan device was found: install a driver such as"), 0u) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos);
  error.clear();
  EXPECT_TRUE(listDevices(&error).empty());
  EXPECT_EQ(error.find("No Vulkan device was found"), 0u) << error;
}

TEST(HeadlessTest, ErrorsMayBeIgnored) {
  EXPECT_EQ(makeSelected("no such card", nullptr), nullptr);
}

TEST(HeadlessTest, WhatIsMissingIsPassedOn) {
  DeviceOptions options;
  options.requirements = [](PFN_vkGetInstanceProcAddr, VkInstance, VkPhysicalDevice, Requirements*,
                            std::string* missing) {
    *missing = "It has no heart.";
    return Status::Unsupported;
  };
  std::string error;
  EXPECT_EQ(Device::create(options, &error), nullptr);
  EXPECT_EQ(error, "It has no heart.");
}

TEST(HeadlessTest, DefaultRequirementsNeedNoValidation) {
  std::string error;
  const std::unique_ptr<Device> device = makeSelected("", &error);
  ASSERT_NE(device, nullptr) << error;
  EXPECT_FALSE(device->debugUtils());
  EXPECT_TRUE(device->validationMessages().empty());
  EXPECT_EQ(device->enabled().apiVersion, VK_API_VERSION_1_3);
  EXPECT_TRUE(device->enabled().deviceFeatures & kFeatureSynchronization2);
  EXPECT_TRUE(device->enabled().deviceFeatures & kFeatureDynamicRendering);
  EXPECT_EQ(device->enabled().features.geometryShader, VK_FALSE);
}

class HeadlessDeviceTest : public DeviceTest {};

TEST_F(HeadlessDeviceTest, EnablesWhatIsAskedFor) {
  const std::unique_ptr<Device> made = makeDevice(
      [](PFN_vkGetInstanceProcAddr, VkInstance, VkPhysicalDevice, Requirements* out, std::string*) {
        out->features.geometryShader = VK_TRUE;
        return Status::Ok;
      });
  ASSERT_NE(made, nullptr);
  EXPECT_EQ(made->enabled().features.geometryShader, VK_TRUE);
  EXPECT_TRUE(made->enabled().deviceFeatures & kFeatureSynchronization2);
}

TEST_F(HeadlessDeviceTest, FramesCountWhatFinished) {
  const uint64_t before = device().frame();
  run([&](VkCommandBuffer) {
    EXPECT_EQ(device().frame(), before);
    return true;
  });
  EXPECT_EQ(device().frame(), before + 1);
}

TEST_F(HeadlessDeviceTest, RefusedRecordingIsNotSubmitted) {
  const uint64_t before = device().frame();
  std::string error = "kept";
  EXPECT_FALSE(device().run([](VkCommandBuffer) { return false; }, &error));
  EXPECT_EQ(error, "kept");
  EXPECT_EQ(device().frame(), before);
  // The next one starts from a clean command buffer.
  run([](VkCommandBuffer) { return true; });
}

TEST_F(HeadlessDeviceTest, TimesOneSubmit) {
  std::string error;
  headless::HostBuffer buffer =
      device().createHostBuffer(32 << 20, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &error);
  ASSERT_NE(buffer.data(), nullptr) << error;
  const auto fill = reinterpret_cast<PFN_vkCmdFillBuffer>(device().function("vkCmdFillBuffer"));
  Timing timing;
  const bool done = device().run(
      [&](VkCommandBuffer commands) {
        fill(commands, buffer.buffer(), 0, VK_WHOLE_SIZE, 0x01020304);
        return true;
      },
      &error, &timing);
  ASSERT_TRUE(done) << error;
  EXPECT_GE(timing.cpuSeconds, 0.0);
  EXPECT_LT(timing.cpuSeconds, 60.0);
  EXPECT_GT(timing.gpuSeconds, 0.0);
  EXPECT_LT(timing.gpuSeconds, 60.0);
  EXPECT_EQ(static_cast<const uint32_t*>(buffer.data())[(8 << 20) - 1], 0x01020304u);
}

TEST_F(HeadlessDeviceTest, ResourcesMoveAndGoOnce) {
  std::string error;
  headless::HostBuffer first =
      device().createHostBuffer(100, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, &error);
  ASSERT_NE(first.data(), nullptr) << error;
  const VkBuffer handle = first.buffer();
  headless::HostBuffer second = std::move(first);
  EXPECT_EQ(second.buffer(), handle);
  EXPECT_EQ(second.size(), 100u);
  second = device().createHostBuffer(50, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, &error);
  EXPECT_EQ(second.size(), 50u);

  headless::Image image = device().createImage({16, 8}, VK_FORMAT_R8G8B8A8_UNORM,
                                               VK_IMAGE_USAGE_SAMPLED_BIT, 5, &error);
  ASSERT_NE(image.image(), VkImage{}) << error;
  headless::Image moved = std::move(image);
  EXPECT_EQ(moved.levels(), 5u);
  EXPECT_EQ(moved.extent().width, 16u);
  EXPECT_EQ(moved.format(), VK_FORMAT_R8G8B8A8_UNORM);
  EXPECT_NE(moved.view(), VkImageView{});
}

TEST_F(HeadlessDeviceTest, ImpossibleResourcesAreRefusedWithASentence) {
  std::string error;
  EXPECT_EQ(device().createHostBuffer(0, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, &error).data(), nullptr);
  EXPECT_NE(error.find("0 bytes"), std::string::npos) << error;
  error.clear();
  EXPECT_EQ(
      device()
          .createImage({16, 8}, VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_USAGE_SAMPLED_BIT, 6, &error)
          .image(),
      VkImage{});
  EXPECT_NE(error.find("6 levels"), std::string::npos) << error;
}

TEST_F(HeadlessDeviceTest, UnknownFunctionIsNull) {
  EXPECT_NE(device().function("vkCmdDispatch"), nullptr);
  EXPECT_EQ(device().function("vkNoSuchFunction"), nullptr);
}

TEST_F(HeadlessDeviceTest, MessagesCanBeReadAndCleared) {
  expectMessage("VUID-VkBufferCreateInfo-size-00912");
  const auto createBuffer =
      reinterpret_cast<PFN_vkCreateBuffer>(device().function("vkCreateBuffer"));
  VkBufferCreateInfo info = {};
  info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
  info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
  VkBuffer buffer = VK_NULL_HANDLE;
  device().clearValidationMessages();
  createBuffer(device().device(), &info, nullptr, &buffer);  // Of 0 bytes.
  ASSERT_EQ(device().validationMessages().size(), 1u);
  EXPECT_NE(device().validationMessages()[0].find("00912"), std::string::npos);
  device().clearValidationMessages();
  EXPECT_TRUE(device().validationMessages().empty());
  reinterpret_cast<PFN_vkDestroyBuffer>(device().function("vkDestroyBuffer"))(device().device(),
                                                                              buffer, nullptr);
}

}  // namespace
}  // namespace alpenglow::headless
