#include "picture_target.h"

#include <algorithm>
#include <cstring>

#include "failure.h"

namespace alpenglow::cli {
namespace {

constexpr VkImageUsageFlags kUsage =
    VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
constexpr uint64_t kPixelBytes = 4 * sizeof(float);

struct Limits {
  uint32_t width = 0;
  uint32_t height = 0;
  uint64_t imageBytes = 0;
  uint64_t memoryBytes = 0;  // Of the largest heap on the device.
};

Limits limitsOf(Session* session) {
  const VkPhysicalDevice device = session->device().physicalDevice();
  VkPhysicalDeviceProperties properties = {};
  session->instanceFunction<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties")(
      device, &properties);
  VkPhysicalDeviceMemoryProperties memory = {};
  session->instanceFunction<PFN_vkGetPhysicalDeviceMemoryProperties>(
      "vkGetPhysicalDeviceMemoryProperties")(device, &memory);
  VkImageFormatProperties image = {};
  const VkResult result = session->instanceFunction<PFN_vkGetPhysicalDeviceImageFormatProperties>(
      "vkGetPhysicalDeviceImageFormatProperties")(device, kPictureFormat, VK_IMAGE_TYPE_2D,
                                                  VK_IMAGE_TILING_OPTIMAL, kUsage, 0, &image);
  session->check(result == VK_SUCCESS ? Status::Ok : Status::VulkanError);
  const VkPhysicalDeviceLimits& most = properties.limits;
  Limits limits;
  limits.width =
      std::min({image.maxExtent.width, most.maxFramebufferWidth, most.maxViewportDimensions[0]});
  limits.height =
      std::min({image.maxExtent.height, most.maxFramebufferHeight, most.maxViewportDimensions[1]});
  limits.imageBytes = image.maxResourceSize;
  for (uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
    const VkMemoryHeap& heap = memory.memoryHeaps[i];
    if ((heap.flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) == 0) continue;
    limits.memoryBytes = std::max(limits.memoryBytes, heap.size);
  }
  return limits;
}

std::string sizeText(uint32_t width, uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

}  // namespace

PictureTarget createPictureTarget(Session* session, uint32_t width, uint32_t height) {
  const uint64_t bytes = uint64_t{width} * height * kPixelBytes;
  const std::string picture = "A picture of " + sizeText(width, height) + " pixels, " +
                              std::to_string(bytes) + " bytes, doesn't fit the device '" +
                              session->device().name() + "': ";
  const Limits limits = limitsOf(session);
  if (width > limits.width || height > limits.height) {
    throw Failure(picture + "it draws at most " + sizeText(limits.width, limits.height) + ".");
  }
  if (bytes > limits.imageBytes) {
    throw Failure(picture + "its images have at most " + std::to_string(limits.imageBytes) +
                  " bytes.");
  }
  // More than a heap may not even be asked for; whether so much is free, the driver tells.
  if (bytes > limits.memoryBytes) {
    throw Failure(picture + "it has " + std::to_string(limits.memoryBytes) + " bytes of memory.");
  }
  try {
    return {session->image({width, height}, kPictureFormat, kUsage, 1),
            session->hostBuffer(bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT)};
  } catch (const Failure& failure) {
    throw Failure(picture + failure.what());
  }
}

io::LinearImage readPicture(Session* session, const PictureTarget& target) {
  const VkExtent2D size = target.image.extent();
  const size_t pixels = size_t{size.width} * size.height;
  session->run([&](VkCommandBuffer commands) {
    VkBufferImageCopy copy = {};
    copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    copy.imageExtent = {size.width, size.height, 1};
    session->function<PFN_vkCmdCopyImageToBuffer>("vkCmdCopyImageToBuffer")(
        commands, target.image.image(), samples::kCopySource.layout, target.readback.buffer(), 1,
        &copy);
    session->gpu().barrier(
        commands, samples::kCopyTarget,
        {VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT});
    return "readback";
  });
  io::LinearImage image{size.width, size.height, std::vector<float>(pixels * 3)};
  const float* rgba = static_cast<const float*>(target.readback.data());
  for (size_t i = 0; i < pixels; ++i) {
    std::memcpy(&image.pixels[i * 3], rgba + i * 4, 3 * sizeof(float));
  }
  return image;
}

}  // namespace alpenglow::cli
