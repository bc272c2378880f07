// Buffers and images of a headless device.
#include <alpenglow/headless.h>

#include <bit>
#include <utility>

#include "engine/headless/impl.h"
#include "engine/structure.h"

namespace alpenglow::headless {
namespace {

using engine::structure;

VkImageAspectFlags aspectOf(VkFormat format) {
  switch (format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_D32_SFLOAT:
      return VK_IMAGE_ASPECT_DEPTH_BIT;
    case VK_FORMAT_D16_UNORM_S8_UINT:
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
      return VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    default:
      return VK_IMAGE_ASPECT_COLOR_BIT;
  }
}

}  // namespace

uint32_t Device::Impl::memoryType(uint32_t typeBits, VkMemoryPropertyFlags required,
                                  VkMemoryPropertyFlags preferred) const {
  for (const VkMemoryPropertyFlags wanted : {required | preferred, required}) {
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
      if ((typeBits >> i & 1u) != 0 && (memory.memoryTypes[i].propertyFlags & wanted) == wanted) {
        return i;
      }
    }
  }
  return UINT32_MAX;
}

bool Device::Impl::allocate(const VkMemoryRequirements& requirements,
                            VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred,
                            VkDeviceMemory* out, std::string* error) const {
  const uint32_t type = memoryType(requirements.memoryTypeBits, required, preferred);
  if (type == UINT32_MAX) {
    return setError(error, "The device \"" + name + "\" has no memory with the properties " +
                               std::to_string(required) + " that the resource can use.");
  }
  auto info = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.allocationSize = requirements.size;
  info.memoryTypeIndex = type;
  const VkResult result = vk().AllocateMemory(device, &info, nullptr, out);
  if (result < 0) {
    *out = VK_NULL_HANDLE;
    const std::string call = "vkAllocateMemory of " + std::to_string(requirements.size) + " bytes";
    return setError(error, resultSentence(call.c_str(), result));
  }
  return true;
}

HostBuffer::HostBuffer(HostBuffer&& other) noexcept { *this = std::move(other); }

HostBuffer& HostBuffer::operator=(HostBuffer&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(memory_, other.memory_);
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

HostBuffer::~HostBuffer() {
  if (device_ == nullptr) return;
  const Device::Impl& impl = *device_->impl_;
  impl.vk().DestroyBuffer(impl.device, buffer_, nullptr);
  impl.vk().FreeMemory(impl.device, memory_, nullptr);  // Unmaps it.
}

Image::Image(Image&& other) noexcept { *this = std::move(other); }

Image& Image::operator=(Image&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(image_, other.image_);
  std::swap(view_, other.view_);
  std::swap(memory_, other.memory_);
  std::swap(format_, other.format_);
  std::swap(extent_, other.extent_);
  std::swap(levels_, other.levels_);
  return *this;
}

Image::~Image() {
  if (device_ == nullptr) return;
  const Device::Impl& impl = *device_->impl_;
  impl.vk().DestroyImageView(impl.device, view_, nullptr);
  impl.vk().DestroyImage(impl.device, image_, nullptr);
  impl.vk().FreeMemory(impl.device, memory_, nullptr);
}

HostBuffer Device::createHostBuffer(VkDeviceSize size, VkBufferUsageFlags usage,
                                    std::string* error) {
  const Impl& impl = *impl_;
  const Functions& vk = impl.vk();
  if (size == 0 || usage == 0) {
    setError(error, "A host buffer has " + std::to_string(size) + " bytes and usage " +
                        std::to_string(usage) + ", but neither may be 0.");
    return {};
  }
  HostBuffer buffer;
  buffer.device_ = this;  // From here on its destructor cleans up.
  buffer.size_ = size;
  auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = size;
  info.usage = usage;
  VkResult result = vk.CreateBuffer(impl.device, &info, nullptr, &buffer.buffer_);
  if (result < 0) {
    buffer.buffer_ = VK_NULL_HANDLE;
    setError(error, resultSentence("vkCreateBuffer", result));
    return {};
  }
  VkMemoryRequirements requirements = {};
  vk.GetBufferMemoryRequirements(impl.device, buffer.buffer_, &requirements);
  constexpr VkMemoryPropertyFlags kHost =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  if (!impl.allocate(requirements, kHost, VK_MEMORY_PROPERTY_HOST_CACHED_BIT, &buffer.memory_,
                     error)) {
    return {};
  }
  result = vk.BindBufferMemory(impl.device, buffer.buffer_, buffer.memory_, 0);
  if (result >= 0) {
    result = vk.MapMemory(impl.device, buffer.memory_, 0, VK_WHOLE_SIZE, 0, &buffer.data_);
  }
  if (result < 0) {
    setError(error, resultSentence("Binding or mapping a host buffer", result));
    return {};
  }
  return buffer;
}

Image Device::createImage(VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
                          uint32_t levels, std::string* error, VkSampleCountFlagBits samples) {
  const Impl& impl = *impl_;
  const Functions& vk = impl.vk();
  const uint32_t longest = extent.width > extent.height ? extent.width : extent.height;
  if (extent.width == 0 || extent.height == 0 || levels == 0 ||
      levels > static_cast<uint32_t>(std::bit_width(longest))) {
    setError(error, "An image has " + std::to_string(extent.width) + "x" +
                        std::to_string(extent.height) + " pixels and " + std::to_string(levels) +
                        " levels, but none may be 0 and the levels at most those down to 1x1.");
    return {};
  }
  Image image;
  image.device_ = this;  // From here on its destructor cleans up.
  image.format_ = format;
  image.extent_ = extent;
  image.levels_ = levels;
  auto info = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {extent.width, extent.height, 1};
  info.mipLevels = levels;
  info.arrayLayers = 1;
  info.samples = samples;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = usage;
  VkResult result = vk.CreateImage(impl.device, &info, nullptr, &image.image_);
  if (result < 0) {
    image.image_ = VK_NULL_HANDLE;
    setError(error, resultSentence("vkCreateImage", result));
    return {};
  }
  VkMemoryRequirements requirements = {};
  vk.GetImageMemoryRequirements(impl.device, image.image_, &requirements);
  if (!impl.allocate(requirements, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, &image.memory_, error)) {
    return {};
  }
  result = vk.BindImageMemory(impl.device, image.image_, image.memory_, 0);
  if (result < 0) {
    setError(error, resultSentence("vkBindImageMemory", result));
    return {};
  }
  auto view = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  view.image = image.image_;
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {aspectOf(format), 0, levels, 0, 1};
  result = vk.CreateImageView(impl.device, &view, nullptr, &image.view_);
  if (result < 0) {
    image.view_ = VK_NULL_HANDLE;
    setError(error, resultSentence("vkCreateImageView", result));
    return {};
  }
  return image;
}

}  // namespace alpenglow::headless
