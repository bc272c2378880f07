// Images with a tracked state. Plain structs: whoever owns one releases it.
#pragma once

#include <alpenglow/types.h>

#include "engine/device.h"

namespace alpenglow::engine {

/// Vulkan's stages, accesses and layout of an image at one point of a command buffer.
struct ImageState {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 access = VK_ACCESS_2_NONE;
};

/// Always optimal tiling and one sample.
struct ImageDesc {
  VkImageType type = VK_IMAGE_TYPE_2D;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkExtent3D extent = {1, 1, 1};
  uint32_t mipLevels = 1;
  uint32_t arrayLayers = 1;
  VkImageUsageFlags usage = 0;
  bool linearFilter = true;  ///< Sampled usage asks the format for linear filtering too.
  const char* name = "";     ///< Copied; for error sentences and debug names.
};

/// The tracked state of an image.
struct ImageTrack {
  /// The state that commands recorded so far leave behind: the layout, and the last writer or all
  /// readers since. Barriers keeps it up to date; it follows recording order, so command buffers
  /// must be submitted in the order in which they were recorded.
  ImageState state;
  VkPipelineStageFlags2 writeStage = VK_PIPELINE_STAGE_2_NONE;  ///< Of the last write.
  VkAccessFlags2 writeAccess = VK_ACCESS_2_NONE;
};

struct Image : ImageTrack {
  VkImage handle = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;  ///< All levels and layers; made when memory is bound.
  ImageDesc desc;                     ///< Its name is dangling: use Image::name.
  char name[48] = "";
  uint64_t bytes = 0;  ///< Of its memory requirements.
};

/// Makes the VkImage; memory and view come with allocateAndBind. Unsupported, with a sentence, when
/// the device's format lacks a feature that the usage needs or a limit is exceeded;
/// InvalidArgument for a zero extent or usage. On failure `*out` is empty.
Status createImage(Device& device, const ImageDesc& desc, Image* out);

/// Ok, or Unsupported with a sentence: what createImage checks before it asks Vulkan.
Status checkImage(const Device& device, const ImageDesc& desc);

/// Destroys view and image now and empties the struct. Memory is freed apart, afterwards.
void destroyImage(Device& device, Image* image);
/// The same once `frame` has completed.
void deferImage(Device& device, uint64_t frame, Image* image);

/// Every level and layer, with the aspects of the format.
VkImageSubresourceRange wholeImage(const Image& image);
/// Color, or depth and stencil, by the format.
VkImageAspectFlags formatAspects(VkFormat format);

}  // namespace alpenglow::engine
