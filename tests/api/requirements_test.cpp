// What a device lacks, reported before a host makes one; on a mock Vulkan.
#include <alpenglow/context.h>
#include <gtest/gtest.h>

#include "tests/engine/mock_vulkan.h"

namespace alpenglow {
namespace {

using testing::MockVulkan;

class QueryRequirementsTest : public ::testing::Test {
 protected:
  QueryRequirementsTest() { mock_.features.dualSrcBlend = mock_.features.depthClamp = VK_TRUE; }

  Status query(CapabilityFlags wanted) {
    const engine::DeviceDesc device = mock_.deviceDesc();
    ContextDesc desc;
    desc.instance = device.instance;
    desc.physicalDevice = device.physicalDevice;
    desc.getInstanceProcAddr = device.getInstanceProcAddr;
    desc.capabilities = wanted;
    desc.diagnostics = {device.diagnostic, device.user};
    return queryRequirements(desc, &found_);
  }
  MockVulkan mock_;
  Requirements found_;
};

TEST_F(QueryRequirementsTest, AnswersWhatIsAskedFor) {
  EXPECT_EQ(query(0), Status::Ok);
  EXPECT_EQ(found_.apiVersion, VK_API_VERSION_1_3);
  EXPECT_EQ(found_.capabilities, kCapabilityBake | kCapabilitySky);
  EXPECT_EQ(found_.deviceFeatures, kFeatureSynchronization2 | kFeatureDynamicRendering);
  EXPECT_EQ(found_.features.dualSrcBlend, VK_FALSE);
  EXPECT_EQ(query(kCapabilityBake), Status::Ok);
  EXPECT_EQ(found_.deviceFeatures, kFeatureSynchronization2);
  EXPECT_TRUE(mock_.diagnostics.empty());
}

TEST_F(QueryRequirementsTest, WhatTheDeviceHasRemains) {
  mock_.features.dualSrcBlend = VK_FALSE;
  EXPECT_EQ(query(kCapabilityBake | kCapabilitySky | kCapabilityAerialPerspective |
                  kCapabilityLightShafts | kCapabilityShadowVolumes),
            Status::Unsupported);
  EXPECT_EQ(mock_.lastDiagnostic(),
            "The device \"mock\" lacks what is needed: independentBlend, geometryShader, "
            "dualSrcBlend, shaderClipDistance.");
  EXPECT_EQ(mock_.diagnostics.size(), 1u);
  EXPECT_EQ(found_.capabilities, kCapabilityBake | kCapabilitySky | kCapabilityLightShafts);
  EXPECT_EQ(found_.features.depthClamp, VK_TRUE);
  EXPECT_EQ(found_.features.geometryShader, VK_FALSE);
  EXPECT_EQ(query(found_.capabilities), Status::Ok);
}

TEST_F(QueryRequirementsTest, ShadowVolumesGoWithTheirLightShafts) {
  mock_.features.geometryShader = mock_.features.shaderClipDistance = VK_TRUE;
  mock_.features.independentBlend = VK_TRUE;
  mock_.features.depthClamp = VK_FALSE;
  EXPECT_EQ(query(kCapabilitySky | kCapabilityLightShafts | kCapabilityShadowVolumes),
            Status::Unsupported);
  EXPECT_EQ(found_.capabilities, CapabilityFlags{kCapabilitySky});
}

TEST_F(QueryRequirementsTest, WithoutDynamicRenderingTheBakeRemains) {
  mock_.dynamicRendering = false;
  EXPECT_EQ(query(0), Status::Unsupported);
  EXPECT_EQ(found_.capabilities, CapabilityFlags{kCapabilityBake});
  EXPECT_EQ(found_.deviceFeatures, kFeatureSynchronization2);
}

TEST_F(QueryRequirementsTest, AnOldDeviceOrLoaderIsTheReasonAndNothingRemains) {
  for (const bool loader : {false, true}) {
    (loader ? mock_.loaderVersion : mock_.properties.apiVersion) = VK_API_VERSION_1_2;
    EXPECT_EQ(query(0), Status::Unsupported);
    EXPECT_NE(mock_.lastDiagnostic().find("Vulkan 1.3 (it is 1.2)"), std::string::npos);
    EXPECT_EQ(mock_.lastDiagnostic().find("synchronization2"), std::string::npos)
        << mock_.lastDiagnostic();
    EXPECT_EQ(found_.capabilities, 0u);
    EXPECT_EQ(found_.deviceFeatures, 0u);
    mock_.properties.apiVersion = VK_API_VERSION_1_3;
  }
}

TEST_F(QueryRequirementsTest, WrongArgumentsLeaveTheAnswer) {
  ASSERT_EQ(query(kCapabilityAerialPerspective), Status::Ok);
  EXPECT_EQ(query(1u << 9), Status::InvalidArgument);
  EXPECT_NE(mock_.lastDiagnostic().find("ContextDesc::capabilities is 512"), std::string::npos);
  EXPECT_EQ(found_.capabilities, CapabilityFlags{kCapabilityAerialPerspective});
}

}  // namespace
}  // namespace alpenglow
