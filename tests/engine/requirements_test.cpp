#include "engine/requirements.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>

#include "tests/engine/mock_vulkan.h"

namespace alpenglow::engine {
namespace {

using testing::MockVulkan;

class RequirementsTest : public ::testing::Test {
 protected:
  RequirementsTest() {
    needed_.apiVersion = VK_API_VERSION_1_3;
    needed_.synchronization2 = true;
    needed_.dynamicRendering = true;
  }
  Status check() {
    const DeviceDesc desc = mock_.deviceDesc();
    return checkPhysicalDevice(desc.getInstanceProcAddr, desc.instance, desc.physicalDevice,
                               needed_, desc.diagnostic, desc.user);
  }
  MockVulkan mock_;
  FeatureSet needed_;
};

TEST_F(RequirementsTest, DeviceWithEverythingPasses) {
  needed_.core.geometryShader = VK_TRUE;
  mock_.features.geometryShader = VK_TRUE;
  EXPECT_EQ(check(), Status::Ok);
  EXPECT_TRUE(mock_.diagnostics.empty());
}

TEST_F(RequirementsTest, EveryGapIsListed) {
  needed_.core.geometryShader = VK_TRUE;
  needed_.core.inheritedQueries = VK_TRUE;
  needed_.core.depthClamp = VK_TRUE;
  mock_.features.depthClamp = VK_TRUE;
  mock_.synchronization2 = false;
  EXPECT_EQ(check(), Status::Unsupported);
  EXPECT_EQ(mock_.lastDiagnostic(),
            "The device \"mock\" lacks what is needed: synchronization2, geometryShader, "
            "inheritedQueries.");
}

TEST_F(RequirementsTest, OldDeviceIsNotAskedForNewFeatures) {
  mock_.properties.apiVersion = VK_API_VERSION_1_2;
  EXPECT_EQ(check(), Status::Unsupported);
  EXPECT_EQ(mock_.lastDiagnostic(),
            "The device \"mock\" lacks what is needed: Vulkan 1.3 (it is 1.2).");
}

TEST_F(RequirementsTest, AnOldVersionIsTheReasonAndOtherGapsFollow) {
  needed_.core.geometryShader = VK_TRUE;
  mock_.synchronization2 = false;
  mock_.loaderVersion = VK_API_VERSION_1_1;
  EXPECT_EQ(check(), Status::Unsupported);
  EXPECT_EQ(mock_.lastDiagnostic(),
            "The device \"mock\" lacks what is needed: a loader of Vulkan 1.3 (it is 1.1), "
            "geometryShader.");
  mock_.properties.apiVersion = VK_API_VERSION_1_2;
  EXPECT_EQ(check(), Status::Unsupported);
  EXPECT_EQ(mock_.lastDiagnostic(),
            "The device \"mock\" lacks what is needed: Vulkan 1.3 (it is 1.2), a loader of Vulkan "
            "1.3 (it is 1.1), geometryShader.");
  EXPECT_EQ(mock_.diagnostics.size(), 2u);
}

TEST_F(RequirementsTest, ALoaderThatSaysNothingIsNotRefused) {
  mock_.missingFunction = "vkEnumerateInstanceVersion";
  EXPECT_EQ(check(), Status::Ok);
}

TEST_F(RequirementsTest, WhatIsOfferedIsAnsweredWhereItIsNotEnough) {
  needed_.core.geometryShader = VK_TRUE;
  mock_.features.depthClamp = VK_TRUE;
  FeatureSet offered;
  const DeviceDesc desc = mock_.deviceDesc();
  EXPECT_EQ(checkPhysicalDevice(desc.getInstanceProcAddr, desc.instance, desc.physicalDevice,
                                needed_, nullptr, nullptr, &offered),
            Status::Unsupported);
  EXPECT_TRUE(offered.synchronization2);
  EXPECT_EQ(offered.core.depthClamp, VK_TRUE);
  EXPECT_FALSE(offersAll(offered, needed_));
  needed_.core.geometryShader = VK_FALSE;
  EXPECT_TRUE(offersAll(offered, needed_));
}

TEST_F(RequirementsTest, AllFeaturesMissingStillFitTheSentence) {
  std::array<VkBool32, sizeof(VkPhysicalDeviceFeatures) / sizeof(VkBool32)> all;
  all.fill(VK_TRUE);
  needed_.core = std::bit_cast<VkPhysicalDeviceFeatures>(all);
  EXPECT_EQ(check(), Status::Unsupported);
  EXPECT_NE(mock_.lastDiagnostic().find("robustBufferAccess, "), std::string::npos);
  EXPECT_NE(mock_.lastDiagnostic().find(", inheritedQueries."), std::string::npos);
}

TEST_F(RequirementsTest, NullHandlesAreNamed) {
  const DeviceDesc desc = mock_.deviceDesc();
  EXPECT_EQ(checkPhysicalDevice(nullptr, desc.instance, desc.physicalDevice, needed_,
                                desc.diagnostic, desc.user),
            Status::InvalidArgument);
  EXPECT_NE(mock_.lastDiagnostic().find("getInstanceProcAddr"), std::string::npos);
  EXPECT_EQ(checkPhysicalDevice(desc.getInstanceProcAddr, VK_NULL_HANDLE, desc.physicalDevice,
                                needed_, desc.diagnostic, desc.user),
            Status::InvalidArgument);
  EXPECT_NE(mock_.lastDiagnostic().find("instance"), std::string::npos);
  EXPECT_EQ(checkPhysicalDevice(desc.getInstanceProcAddr, desc.instance, VK_NULL_HANDLE, needed_,
                                nullptr, nullptr),
            Status::InvalidArgument);
}

TEST_F(RequirementsTest, InstanceOfVulkan10IsRefused) {
  mock_.missingFunction = "vkGetPhysicalDeviceFeatures2";
  EXPECT_EQ(check(), Status::Unsupported);
  EXPECT_NE(mock_.lastDiagnostic().find("vkGetPhysicalDeviceFeatures2"), std::string::npos);
}

TEST_F(RequirementsTest, MergeKeepsTheGreaterOfBoth) {
  FeatureSet other;
  other.apiVersion = VK_API_VERSION_1_1;
  other.core.geometryShader = VK_TRUE;
  needed_.dynamicRendering = false;
  needed_.core.depthClamp = VK_TRUE;
  mergeFeatures(other, &needed_);
  EXPECT_EQ(needed_.apiVersion, VK_API_VERSION_1_3);
  EXPECT_TRUE(needed_.synchronization2);
  EXPECT_FALSE(needed_.dynamicRendering);
  EXPECT_EQ(needed_.core.geometryShader, VK_TRUE);
  EXPECT_EQ(needed_.core.depthClamp, VK_TRUE);
}

}  // namespace
}  // namespace alpenglow::engine
