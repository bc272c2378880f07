#include "engine/barriers.h"

#include <gtest/gtest.h>

#include "tests/engine/mock_vulkan.h"

namespace alpenglow::engine {
namespace {

using testing::MockVulkan;

constexpr VkPipelineStageFlags2 kCompute = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
constexpr VkPipelineStageFlags2 kFragment = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
constexpr VkAccessFlags2 kStorageWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
constexpr VkAccessFlags2 kSampledRead = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;

class BarriersTest : public ::testing::Test {
 protected:
  BarriersTest() : device_(mock_.makeDevice()) {
    image_.handle = handleFrom<VkImage>(50);
    image_.desc.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    image_.desc.mipLevels = 3;
    image_.desc.arrayLayers = 2;
  }
  ~BarriersTest() override { Device::destroy(device_); }

  /// Records and returns how many image barriers came.
  size_t record() {
    mock_.imageBarriers.clear();
    mock_.memoryBarriers.clear();
    EXPECT_EQ(barriers_.record(*device_, VK_NULL_HANDLE), Status::Ok);
    EXPECT_TRUE(barriers_.empty());
    return mock_.imageBarriers.size();
  }
  void put(const ImageState& state) {
    barriers_.image(image_, state);
    record();
  }
  const VkImageMemoryBarrier2& first() { return mock_.imageBarriers.at(0); }

  MockVulkan mock_;
  Device* device_;
  Barriers barriers_;
  Image image_;
};

TEST_F(BarriersTest, FirstUseWaitsForNothingAndLeavesUndefined) {
  barriers_.image(image_, kComputeWrite);
  ASSERT_EQ(record(), 1u);
  EXPECT_EQ(first().oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_EQ(first().newLayout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(first().srcStageMask, VK_PIPELINE_STAGE_2_NONE);
  EXPECT_EQ(first().srcAccessMask, VK_ACCESS_2_NONE);
  EXPECT_EQ(first().dstStageMask, kCompute);
  EXPECT_EQ(first().dstAccessMask, kStorageWrite);
  EXPECT_EQ(first().subresourceRange.levelCount, 3u);
  EXPECT_EQ(first().subresourceRange.layerCount, 2u);
  EXPECT_EQ(first().subresourceRange.aspectMask, VkImageAspectFlags{VK_IMAGE_ASPECT_COLOR_BIT});
  EXPECT_EQ(first().srcQueueFamilyIndex, VK_QUEUE_FAMILY_IGNORED);
  EXPECT_EQ(image_.state.layout, VK_IMAGE_LAYOUT_GENERAL);
}

TEST_F(BarriersTest, ReadAfterWriteMakesTheWriteAvailable) {
  put(kComputeWrite);
  barriers_.image(image_, kComputeSampled);
  ASSERT_EQ(record(), 1u);
  EXPECT_EQ(first().srcStageMask, kCompute);
  EXPECT_EQ(first().srcAccessMask, kStorageWrite);
  EXPECT_EQ(first().dstStageMask, kCompute);
  EXPECT_EQ(first().dstAccessMask, kSampledRead);
  EXPECT_EQ(first().oldLayout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(first().newLayout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

TEST_F(BarriersTest, ReadAfterReadAlreadyVisibleIsSkipped) {
  put(kComputeWrite);
  put(kComputeSampled);
  const int before = mock_.count("vkCmdPipelineBarrier2");
  barriers_.image(image_, kComputeSampled);
  EXPECT_TRUE(barriers_.empty());
  EXPECT_EQ(record(), 0u);
  EXPECT_EQ(mock_.count("vkCmdPipelineBarrier2"), before);
}

TEST_F(BarriersTest, ReadInAnotherStageWaitsForTheWriterAgain) {
  put(kComputeWrite);
  put(kComputeSampled);
  barriers_.image(image_, kFragmentSampled);
  ASSERT_EQ(record(), 1u);
  EXPECT_NE(first().srcStageMask & kCompute, 0u);
  EXPECT_EQ(first().srcAccessMask, kStorageWrite);
  EXPECT_EQ(first().dstStageMask, kFragment);
  EXPECT_EQ(first().oldLayout, first().newLayout);
  // Now both stages have seen it.
  barriers_.image(image_, kComputeSampled);
  barriers_.image(image_, kFragmentSampled);
  EXPECT_EQ(record(), 0u);
}

TEST_F(BarriersTest, WriteAfterReadWaitsForEveryReader) {
  put(kComputeWrite);
  put(kComputeSampled);
  put(kFragmentSampled);
  barriers_.image(image_, kComputeWrite);
  ASSERT_EQ(record(), 1u);
  EXPECT_EQ(first().srcStageMask, kCompute | kFragment);
  EXPECT_EQ(first().dstAccessMask, kStorageWrite);
  EXPECT_EQ(image_.state.stage, kCompute);
}

TEST_F(BarriersTest, WriteAfterWriteInOneLayoutIsNeverSkipped) {
  put(kComputeWrite);
  barriers_.image(image_, kComputeWrite);
  ASSERT_EQ(record(), 1u);
  EXPECT_EQ(first().oldLayout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(first().srcStageMask, kCompute);
  EXPECT_EQ(first().srcAccessMask, kStorageWrite);
}

TEST_F(BarriersTest, ReadWriteWaitsForReadWrite) {
  put(kComputeReadWrite);
  barriers_.image(image_, kComputeReadWrite);
  ASSERT_EQ(record(), 1u);
  EXPECT_EQ(first().srcAccessMask, kStorageWrite);
  EXPECT_EQ(first().dstAccessMask, kComputeReadWrite.access);
}

TEST_F(BarriersTest, DiscardForgetsTheContentButNotTheReaders) {
  put(kComputeWrite);
  put(kFragmentSampled);
  barriers_.discard(image_, kFragmentSampled);
  ASSERT_EQ(record(), 1u);
  EXPECT_EQ(first().oldLayout, VK_IMAGE_LAYOUT_UNDEFINED);
  EXPECT_NE(first().srcStageMask & kFragment, 0u);
}

TEST_F(BarriersTest, LayoutChangeBetweenReadsIsABarrier) {
  put(kComputeWrite);
  put(kComputeSampled);
  barriers_.image(image_, kTransferSource);
  ASSERT_EQ(record(), 1u);
  EXPECT_EQ(first().srcStageMask, kCompute);
  EXPECT_EQ(first().newLayout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
  EXPECT_EQ(image_.state.access, VkAccessFlags2{VK_ACCESS_2_TRANSFER_READ_BIT});
}

TEST_F(BarriersTest, TwoReadersInOneBatchShareABarrier) {
  put(kComputeWrite);
  barriers_.image(image_, kComputeSampled);
  barriers_.image(image_, kFragmentSampled);
  ASSERT_EQ(record(), 1u);
  EXPECT_EQ(first().srcAccessMask, kStorageWrite);
  EXPECT_EQ(first().dstStageMask, kCompute | kFragment);
  EXPECT_EQ(image_.state.stage, kCompute | kFragment);
}

TEST_F(BarriersTest, LastLayoutOfABatchWins) {
  put(kComputeWrite);
  barriers_.image(image_, kComputeSampled);
  barriers_.image(image_, kTransferDestination);
  ASSERT_EQ(record(), 1u);
  EXPECT_EQ(first().oldLayout, VK_IMAGE_LAYOUT_GENERAL);
  EXPECT_EQ(first().newLayout, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  EXPECT_EQ(first().dstAccessMask, VkAccessFlags2{VK_ACCESS_2_TRANSFER_WRITE_BIT});
  EXPECT_EQ(image_.writeAccess, VkAccessFlags2{VK_ACCESS_2_TRANSFER_WRITE_BIT});
}

TEST_F(BarriersTest, ForeignImageGoesThroughUnchanged) {
  const VkImageSubresourceRange range = {VK_IMAGE_ASPECT_DEPTH_BIT, 1, 2, 3, 4};
  const ImageState before = {VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, VK_PIPELINE_STAGE_2_NONE, 0};
  barriers_.foreign(handleFrom<VkImage>(9), before, kFragmentSampled, range);
  ASSERT_EQ(record(), 1u);
  EXPECT_EQ(first().image, handleFrom<VkImage>(9));
  EXPECT_EQ(first().oldLayout, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
  EXPECT_EQ(first().srcStageMask, VK_PIPELINE_STAGE_2_NONE);
  EXPECT_EQ(first().dstStageMask, kFragment);
  EXPECT_EQ(first().subresourceRange.aspectMask, range.aspectMask);
  EXPECT_EQ(first().subresourceRange.baseArrayLayer, 3u);
}

TEST_F(BarriersTest, MemoryBarriersAreMergedAndSentWithImages) {
  barriers_.image(image_, kComputeWrite);
  barriers_.memory(VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, kCompute,
                   VK_ACCESS_2_UNIFORM_READ_BIT);
  barriers_.memory(kCompute, kStorageWrite, VK_PIPELINE_STAGE_2_HOST_BIT,
                   VK_ACCESS_2_HOST_READ_BIT);
  EXPECT_EQ(record(), 1u);
  EXPECT_EQ(mock_.count("vkCmdPipelineBarrier2"), 1);
  ASSERT_EQ(mock_.memoryBarriers.size(), 1u);
  EXPECT_EQ(mock_.memoryBarriers[0].srcStageMask, VK_PIPELINE_STAGE_2_COPY_BIT | kCompute);
  EXPECT_EQ(mock_.memoryBarriers[0].dstAccessMask,
            VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_HOST_READ_BIT);
  // Nothing is left over for the next batch.
  barriers_.image(image_, kComputeSampled);
  record();
  EXPECT_TRUE(mock_.memoryBarriers.empty());
  barriers_.memory(kFragment, 0, kFragment, 0);
  record();
  ASSERT_EQ(mock_.memoryBarriers.size(), 1u);
  EXPECT_EQ(mock_.memoryBarriers[0].srcStageMask, kFragment);
  EXPECT_EQ(mock_.memoryBarriers[0].dstAccessMask, VK_ACCESS_2_NONE);
}

TEST_F(BarriersTest, EmptyBatchRecordsNothing) {
  EXPECT_EQ(record(), 0u);
  EXPECT_EQ(mock_.count("vkCmdPipelineBarrier2"), 0);
}

TEST_F(BarriersTest, OverfullBatchIsRefusedWhole) {
  for (uint32_t i = 0; i <= Barriers::kImageCapacity; ++i) {
    barriers_.foreign(handleFrom<VkImage>(100 + i), {}, kFragmentSampled, {});
  }
  EXPECT_EQ(barriers_.record(*device_, VK_NULL_HANDLE), Status::InvalidArgument);
  EXPECT_EQ(mock_.lastDiagnostic(),
            "A batch of barriers has 25 images, but at most 24 are expected.");
  EXPECT_EQ(mock_.count("vkCmdPipelineBarrier2"), 0);
  EXPECT_TRUE(barriers_.empty());
}

TEST_F(BarriersTest, AssertLayoutNamesImageAndLayouts) {
  std::snprintf(image_.name, sizeof(image_.name), "scattering");
  put(kComputeWrite);
  EXPECT_EQ(assertLayout(*device_, image_, VK_IMAGE_LAYOUT_GENERAL), Status::Ok);
  EXPECT_TRUE(mock_.diagnostics.empty());
  EXPECT_EQ(assertLayout(*device_, image_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL),
            Status::InvalidArgument);
  EXPECT_EQ(mock_.lastDiagnostic(),
            "Image \"scattering\" is used in layout VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL (5) "
            "while it is in VK_IMAGE_LAYOUT_GENERAL (1).");
}

TEST(WritesTest, TellsWritesFromReads) {
  for (const VkAccessFlags2 access :
       {VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_ACCESS_2_SHADER_WRITE_BIT,
        VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT,
        VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_ACCESS_2_HOST_WRITE_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT}) {
    EXPECT_TRUE(writes(access)) << access;
  }
  for (const VkAccessFlags2 access :
       {VK_ACCESS_2_NONE, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT,
        VK_ACCESS_2_TRANSFER_READ_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT,
        VK_ACCESS_2_MEMORY_READ_BIT, VK_ACCESS_2_UNIFORM_READ_BIT}) {
    EXPECT_FALSE(writes(access)) << access;
  }
}

}  // namespace
}  // namespace alpenglow::engine
