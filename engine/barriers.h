// Barriers from tracked image states, gathered and recorded by one vkCmdPipelineBarrier2.
#pragma once

#include "engine/image.h"

namespace alpenglow::engine {

/// Common states, for `image` and `discard`.
inline constexpr ImageState kComputeWrite = {VK_IMAGE_LAYOUT_GENERAL,
                                             VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                             VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
inline constexpr ImageState kComputeReadWrite = {
    VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
    VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT};
inline constexpr ImageState kComputeSampled = {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                               VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                               VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
inline constexpr ImageState kFragmentSampled = {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                                VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                                VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
inline constexpr ImageState kTransferSource = {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL,
                                               VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                               VK_ACCESS_2_TRANSFER_READ_BIT};
inline constexpr ImageState kTransferDestination = {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                                    VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                                                    VK_ACCESS_2_TRANSFER_WRITE_BIT};

inline constexpr ImageState kColorDrawn = {
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
inline constexpr ImageState kDepthDrawn = {
    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};

/// A batch of barriers between two steps of work. Fixed capacity, no heap. Call `image` and the
/// others for all that the next step uses, then `record`, which empties the batch.
/// Two calls for one image in one batch are merged: nothing runs between them.
class Barriers {
 public:
  static constexpr uint32_t kImageCapacity = 24;

  /// Makes what was written to the image available to `after`, in its layout, and orders `after`
  /// after earlier accesses. Adds nothing when the layout stays, neither side writes, and the
  /// stages and accesses of `after` have already been reached.
  void image(Image& image, const ImageState& after);
  /// The same, but the old content may be lost: nothing of it is kept in a layout change.
  void discard(Image& image, const ImageState& after);
  /// An image of the host's, whose state we don't track.
  void foreign(VkImage image, const ImageState& before, const ImageState& after,
               const VkImageSubresourceRange& range);
  /// For buffers: a global memory barrier. Several calls are merged into one.
  void memory(VkPipelineStageFlags2 sourceStage, VkAccessFlags2 sourceAccess,
              VkPipelineStageFlags2 destinationStage, VkAccessFlags2 destinationAccess);

  bool empty() const { return imageCount_ == 0 && !hasMemory_; }
  /// Records and empties the batch; nothing when it is empty. InvalidArgument with a sentence when
  /// more than kImageCapacity images were added: then nothing is recorded.
  Status record(const Device& device, VkCommandBuffer commandBuffer);

 private:
  void transition(Image& image, const ImageState& after, bool discard);
  VkImageMemoryBarrier2* find(VkImage image);
  VkImageMemoryBarrier2* add();

  VkImageMemoryBarrier2 images_[kImageCapacity];
  uint32_t imageCount_ = 0;
  uint32_t refused_ = 0;  ///< Images beyond the capacity.
  VkMemoryBarrier2 memory_ = {};
  bool hasMemory_ = false;
};

/// Call it before a descriptor or attachment uses the image: no validation layer reports a wrong
/// layout of a dynamic-rendering attachment. InvalidArgument with a sentence, in every build type,
/// when the image's tracked layout is not `expected`.
Status assertLayout(const Device& device, const Image& image, VkImageLayout expected);

/// Whether the mask holds an access that writes.
bool writes(VkAccessFlags2 access);
/// "VK_IMAGE_LAYOUT_GENERAL"; "VkImageLayout" for one that we don't use.
const char* layoutName(VkImageLayout layout);

}  // namespace alpenglow::engine
