#include "engine/requirements.h"

#include <gtest/gtest.h>

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
    const ContextDesc desc = mock_.contextDesc();
    return checkPhysicalDevice(desc.getInstanceProcAddr, desc.instance, desc.physicalDevice,
                               needed_, desc.diagnostic, desc.user);
  }
  MockVulkan mock_;
  Requirements needed_;
};

TEST_F(RequirementsTest, DeviceWithEverythingPasses) {
  needed_.features.geometryShader = VK_TRUE;
  mock_.features.geometryShader = VK_TRUE;
  EXPECT_EQ(check(), Status::Ok);
  EXPECT_TRUE(mock_.diagnostics.empty());
}

TEST_F(RequirementsTest, EveryGapIsListed) {
  needed_.features.geometryShader = VK_TRUE;
  needed_.features.inheritedQueries = VK_TRUE;
  needed_.features.depthClamp = VK_TRUE;
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
            "The device \"mock\" lacks what is needed: Vulkan 1.3 (it is 1.2), synchronization2, "
            "dynamicRendering.");
}

TEST_F(RequirementsTest, AllFeaturesMissingStillFitTheSentence) {
  VkBool32* const members = &needed_.features.robustBufferAccess;
  for (size_t i = 0; i < sizeof(VkPhysicalDeviceFeatures) / sizeof(VkBool32); ++i) {
    members[i] = VK_TRUE;
  }
  EXPECT_EQ(check(), Status::Unsupported);
  EXPECT_NE(mock_.lastDiagnostic().find("robustBufferAccess, "), std::string::npos);
  EXPECT_NE(mock_.lastDiagnostic().find(", inheritedQueries."), std::string::npos);
}

TEST_F(RequirementsTest, NullHandlesAreNamed) {
  const ContextDesc desc = mock_.contextDesc();
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
  Requirements other;
  other.apiVersion = VK_API_VERSION_1_1;
  other.features.geometryShader = VK_TRUE;
  needed_.dynamicRendering = false;
  needed_.features.depthClamp = VK_TRUE;
  mergeRequirements(other, &needed_);
  EXPECT_EQ(needed_.apiVersion, VK_API_VERSION_1_3);
  EXPECT_TRUE(needed_.synchronization2);
  EXPECT_FALSE(needed_.dynamicRendering);
  EXPECT_EQ(needed_.features.geometryShader, VK_TRUE);
  EXPECT_EQ(needed_.features.depthClamp, VK_TRUE);
}

}  // namespace
}  // namespace alpenglow::engine
