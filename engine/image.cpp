#include "engine/image.h"

#include <algorithm>
#include <bit>
#include <cstdio>

#include "engine/structure.h"

namespace alpenglow::engine {
namespace {

struct UsageFeature {
  VkImageUsageFlags usage;
  VkFormatFeatureFlags feature;
  const char* purpose;
};
constexpr UsageFeature kUsageFeatures[] = {
    {VK_IMAGE_USAGE_STORAGE_BIT, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT, "storage images"},
    {VK_IMAGE_USAGE_SAMPLED_BIT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT, "sampling"},
    {VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT, VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT,
     "colour attachments"},
    {VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT,
     "depth attachments"},
    {VK_IMAGE_USAGE_TRANSFER_SRC_BIT, VK_FORMAT_FEATURE_TRANSFER_SRC_BIT, "copies from it"},
    {VK_IMAGE_USAGE_TRANSFER_DST_BIT, VK_FORMAT_FEATURE_TRANSFER_DST_BIT, "copies to it"},
};

Status checkFormat(const Device& device, const ImageDesc& desc) {
  const VkFormatFeatureFlags features = device.formatProperties(desc.format).optimalTilingFeatures;
  for (const UsageFeature& needed : kUsageFeatures) {
    if ((desc.usage & needed.usage) != 0 && (features & needed.feature) == 0) {
      return device.fail(Status::Unsupported, VK_SUCCESS,
                         "Image \"%s\" needs VkFormat %d for %s, which the device \"%s\" doesn't "
                         "support.",
                         desc.name, static_cast<int>(desc.format), needed.purpose,
                         device.properties().deviceName);
    }
  }
  if ((desc.usage & VK_IMAGE_USAGE_SAMPLED_BIT) != 0 && desc.linearFilter &&
      (features & VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT) == 0) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "Image \"%s\" needs linear filtering of VkFormat %d, which the device "
                       "\"%s\" doesn't support.",
                       desc.name, static_cast<int>(desc.format), device.properties().deviceName);
  }
  return Status::Ok;
}

Status checkExtent(const Device& device, const ImageDesc& desc) {
  const VkExtent3D& extent = desc.extent;
  if (extent.width == 0 || extent.height == 0 || extent.depth == 0 || desc.mipLevels == 0 ||
      desc.arrayLayers == 0 || desc.usage == 0) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "Image \"%s\" has %ux%ux%u texels, %u levels, %u layers and usage 0x%x, but "
                       "none may be 0.",
                       desc.name, extent.width, extent.height, extent.depth, desc.mipLevels,
                       desc.arrayLayers, desc.usage);
  }
  // The greatest extents of a type are at least those of the format unless the driver is short of
  // them for this one usage, so the format's own are asked for.
  VkImageFormatProperties limits = {};
  const VkResult result = device.vk().GetPhysicalDeviceImageFormatProperties(
      device.physicalDevice(), desc.format, desc.type, VK_IMAGE_TILING_OPTIMAL, desc.usage, 0,
      &limits);
  if (result == VK_ERROR_FORMAT_NOT_SUPPORTED) {
    return device.fail(Status::Unsupported, result,
                       "Image \"%s\" needs VkFormat %d with usage 0x%x, which the device \"%s\" "
                       "doesn't support.",
                       desc.name, static_cast<int>(desc.format), desc.usage,
                       device.properties().deviceName);
  }
  if (result < 0) {
    return device.failVk(result, "vkGetPhysicalDeviceImageFormatProperties", "image", desc.name);
  }
  const VkExtent3D& most = limits.maxExtent;
  if (extent.width > most.width || extent.height > most.height || extent.depth > most.depth ||
      desc.mipLevels > limits.maxMipLevels || desc.arrayLayers > limits.maxArrayLayers) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "Image \"%s\" has %ux%ux%u texels, %u levels and %u layers, but the device "
                       "allows at most %ux%ux%u, %u and %u.",
                       desc.name, extent.width, extent.height, extent.depth, desc.mipLevels,
                       desc.arrayLayers, most.width, most.height, most.depth, limits.maxMipLevels,
                       limits.maxArrayLayers);
  }
  const uint32_t longest = std::max({extent.width, extent.height, extent.depth});
  if (desc.mipLevels > static_cast<uint32_t>(std::bit_width(longest))) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "Image \"%s\" has %u levels, but %ux%ux%u texels give at most %d.",
                       desc.name, desc.mipLevels, extent.width, extent.height, extent.depth,
                       static_cast<int>(std::bit_width(longest)));
  }
  return Status::Ok;
}

}  // namespace

Status checkImage(const Device& device, const ImageDesc& desc) {
  if (Status status = checkFormat(device, desc); status != Status::Ok) return status;
  return checkExtent(device, desc);
}

Status createImage(Device& device, const ImageDesc& desc, Image* out) {
  *out = Image{};
  if (Status status = checkImage(device, desc); status != Status::Ok) return status;
  auto info = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = desc.type;
  info.format = desc.format;
  info.extent = desc.extent;
  info.mipLevels = desc.mipLevels;
  info.arrayLayers = desc.arrayLayers;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = desc.usage;
  info.sharingMode = device.sharingMode();
  if (info.sharingMode == VK_SHARING_MODE_CONCURRENT) {
    info.queueFamilyIndexCount = static_cast<uint32_t>(device.queueFamilies().size());
    info.pQueueFamilyIndices = device.queueFamilies().data();
  }
  info.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkImage handle = VK_NULL_HANDLE;
  const VkResult result =
      device.vk().CreateImage(device.handle(), &info, device.allocator(), &handle);
  if (result < 0) return device.failVk(result, "vkCreateImage", "image", desc.name);

  ++device.counters().images;
  out->handle = handle;
  out->desc = desc;
  out->desc.name = "";
  std::snprintf(out->name, sizeof(out->name), "%s", desc.name);
  device.setName(VK_OBJECT_TYPE_IMAGE, handleNumber(handle), out->name);
  return Status::Ok;
}

void destroyImage(Device& device, Image* image) {
  device.destroyObject(VK_OBJECT_TYPE_IMAGE_VIEW, image->view);
  device.destroyObject(VK_OBJECT_TYPE_IMAGE, image->handle);
  *image = Image{};
}

void deferImage(Device& device, uint64_t frame, Image* image) {
  device.deletions().defer(frame, VK_OBJECT_TYPE_IMAGE_VIEW, handleNumber(image->view));
  device.deletions().defer(frame, VK_OBJECT_TYPE_IMAGE, handleNumber(image->handle));
  *image = Image{};
}

VkImageSubresourceRange wholeImage(const Image& image) {
  return {formatAspects(image.desc.format), 0, image.desc.mipLevels, 0, image.desc.arrayLayers};
}

VkImageAspectFlags formatAspects(VkFormat format) {
  switch (format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_D32_SFLOAT:
      return VK_IMAGE_ASPECT_DEPTH_BIT;
    case VK_FORMAT_S8_UINT:
      return VK_IMAGE_ASPECT_STENCIL_BIT;
    case VK_FORMAT_D16_UNORM_S8_UINT:
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
      return VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    default:
      return VK_IMAGE_ASPECT_COLOR_BIT;
  }
}

}  // namespace alpenglow::engine
