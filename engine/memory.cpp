#include "engine/memory.h"

#include <algorithm>
#include <cinttypes>
#include <cstddef>

#include "engine/structure.h"

namespace alpenglow::engine {
namespace {

using Images = Image* const*;
using Buffers = Buffer* const*;

/// The group of resources that share a block.
struct Group {
  const char* name;
  Images images;
  uint32_t imageCount;
  Buffers buffers;
  uint32_t bufferCount;
};

VkMemoryRequirements requirementsOf(const Device& device, const Image& image) {
  VkMemoryRequirements requirements = {};
  device.vk().GetImageMemoryRequirements(device.handle(), image.handle, &requirements);
  return requirements;
}

VkMemoryRequirements requirementsOf(const Device& device, const Buffer& buffer) {
  VkMemoryRequirements requirements = {};
  device.vk().GetBufferMemoryRequirements(device.handle(), buffer.handle, &requirements);
  return requirements;
}

VkDeviceSize alignUp(VkDeviceSize value, VkDeviceSize alignment) {
  return (value + alignment - 1) / alignment * alignment;
}

/// Walks the group in its order in memory, images first, and calls visit(resource, requirements,
/// offset) for each. Returns the requirements of the whole block.
template <class Visit>
VkMemoryRequirements layOut(const Device& device, const Group& group, Visit visit) {
  VkMemoryRequirements block = {0, 1, UINT32_MAX};
  const auto place = [&](auto& resource) {
    const VkMemoryRequirements one = requirementsOf(device, resource);
    const VkDeviceSize offset = alignUp(block.size, one.alignment);
    block.size = offset + one.size;
    block.alignment = std::max(block.alignment, one.alignment);
    block.memoryTypeBits &= one.memoryTypeBits;
    return visit(resource, one, offset);
  };
  for (uint32_t i = 0; i < group.imageCount; ++i) {
    if (!place(*group.images[i])) return block;
  }
  if (group.imageCount > 0 && group.bufferCount > 0) {
    // Buffers are linear and images are not: they mustn't share a page of this size, and pages
    // count from the start of the VkDeviceMemory.
    const VkDeviceSize page = device.limits().bufferImageGranularity;
    block.size = alignUp(block.size, page);
    block.alignment = std::max(block.alignment, page);
  }
  for (uint32_t i = 0; i < group.bufferCount; ++i) {
    if (!place(*group.buffers[i])) return block;
  }
  return block;
}

constexpr uint32_t kNoType = UINT32_MAX;

uint32_t findType(const Device& device, uint32_t typeBits, VkMemoryPropertyFlags properties) {
  const VkPhysicalDeviceMemoryProperties& memory = device.memoryProperties();
  for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
    const bool allowed = (typeBits >> i & 1u) != 0;
    if (allowed && (memory.memoryTypes[i].propertyFlags & properties) == properties) return i;
  }
  return kNoType;
}

Status chooseType(const Device& device, const Group& group, uint32_t typeBits,
                  VkMemoryPropertyFlags properties, uint32_t* type) {
  *type = findType(device, typeBits, properties);
  if (*type == kNoType) {
    *type = findType(device, typeBits,
                     properties & ~VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT});
  }
  if (*type != kNoType) return Status::Ok;
  return device.fail(Status::Unsupported, VK_SUCCESS,
                     "Memory block \"%s\" needs a memory type with properties 0x%x among the types "
                     "0x%x, but the device \"%s\" has none.",
                     group.name, properties, typeBits, device.properties().deviceName);
}

/// What the group needs of its block.
struct Request {
  const char* name;
  VkMemoryRequirements requirements;
  uint32_t type;
  bool mustMap;
};

/// Returns the hook's range to it and reports what is wrong with the range.
Status refuseAnswer(Device& device, const MemoryHooks& hooks, const Request& request,
                    MemoryBlock* block) {
  const MemoryRange answer = block->range;
  block->range = MemoryRange{};
  const bool null = answer.memory == VK_NULL_HANDLE;
  if (!null) hooks.free(hooks.user, answer);
  if (null || answer.offset % request.requirements.alignment != 0) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "The host's memory hook answered %s memory at offset %" PRIu64
                       " for block \"%s\", but memory at a multiple of %" PRIu64 " is expected.",
                       null ? "no" : "some", answer.offset, request.name,
                       request.requirements.alignment);
  }
  return device.fail(Status::InvalidArgument, VK_SUCCESS,
                     "The host's memory hook answered memory with a null mapped pointer for block "
                     "\"%s\", but with mustMap it must keep the range mapped and set "
                     "MemoryRange::mapped.",
                     request.name);
}

Status allocateFromHook(Device& device, const MemoryHooks& hooks, const Request& request,
                        MemoryBlock* block) {
  MemoryRange& range = block->range;
  const VkDeviceSize size = request.requirements.size;
  const VkResult result = hooks.allocate(hooks.user, request.requirements, request.type,
                                         request.mustMap, request.name, &range);
  if (result < 0) {
    range = MemoryRange{};
    return device.fail(Status::OutOfDeviceMemory, result,
                       "The host's memory hook refused %" PRIu64
                       " bytes for block \"%s\": %s (%d).",
                       size, request.name, resultName(result), result);
  }
  if (range.memory == VK_NULL_HANDLE || range.offset % request.requirements.alignment != 0 ||
      (request.mustMap && range.mapped == nullptr)) {
    return refuseAnswer(device, hooks, request, block);
  }
  if (request.mustMap) block->mapped = range.mapped;
  block->size = size;
  device.counters().addBytes(size);
  return Status::Ok;
}

Status allocateFromVulkan(Device& device, const Request& request, MemoryBlock* block) {
  auto info = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.allocationSize = request.requirements.size;
  info.memoryTypeIndex = request.type;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkResult result = device.vk().AllocateMemory(device.handle(), &info, device.allocator(), &memory);
  if (result < 0) {
    return device.fail(statusOf(result), result,
                       "vkAllocateMemory of %" PRIu64 " bytes for block \"%s\" returned %s (%d).",
                       info.allocationSize, request.name, resultName(result), result);
  }
  block->range.memory = memory;
  block->size = info.allocationSize;
  device.counters().addBytes(block->size);
  device.setName(VK_OBJECT_TYPE_DEVICE_MEMORY, handleNumber(memory), request.name);
  if (!request.mustMap) return Status::Ok;
  result = device.vk().MapMemory(device.handle(), memory, 0, block->size, 0, &block->mapped);
  if (result < 0) {
    block->mapped = nullptr;
    return device.failVk(result, "vkMapMemory", "block", request.name);
  }
  return Status::Ok;
}

Status bind(Device& device, const Group& group, const MemoryBlock& block) {
  const Dispatch& vk = device.vk();
  Status status = Status::Ok;
  struct Binder {
    const Dispatch& vk;
    VkDevice device;
    const MemoryBlock& block;
    VkResult operator()(Image& image, VkDeviceSize offset) const {
      return vk.BindImageMemory(device, image.handle, block.range.memory,
                                block.range.offset + offset);
    }
    VkResult operator()(Buffer& buffer, VkDeviceSize offset) const {
      return vk.BindBufferMemory(device, buffer.handle, block.range.memory,
                                 block.range.offset + offset);
    }
  };
  const Binder binder{vk, device.handle(), block};
  layOut(device, group, [&](auto& resource, const VkMemoryRequirements& one, VkDeviceSize offset) {
    const VkResult result = binder(resource, offset);
    if (result < 0) {
      status = device.failVk(result, "Binding memory", "block", group.name);
      return false;
    }
    if constexpr (requires { resource.bytes; }) {
      resource.bytes = one.size;
    } else {
      resource.mapped =
          block.mapped == nullptr ? nullptr : static_cast<std::byte*>(block.mapped) + offset;
    }
    return true;
  });
  return status;
}

VkImageViewType viewType(const ImageDesc& desc) {
  switch (desc.type) {
    case VK_IMAGE_TYPE_1D:
      return desc.arrayLayers > 1 ? VK_IMAGE_VIEW_TYPE_1D_ARRAY : VK_IMAGE_VIEW_TYPE_1D;
    case VK_IMAGE_TYPE_3D:
      return VK_IMAGE_VIEW_TYPE_3D;
    default:
      return desc.arrayLayers > 1 ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
  }
}

/// Whether any usage of the image goes through a view; one that is only copied has none.
bool hasView(const Image& image) {
  return (image.desc.usage & ~VkImageUsageFlags{VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                                VK_IMAGE_USAGE_TRANSFER_DST_BIT}) != 0;
}

Status createView(Device& device, Image* image) {
  auto info = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  info.image = image->handle;
  info.viewType = viewType(image->desc);
  info.format = image->desc.format;
  info.subresourceRange = wholeImage(*image);
  VkImageView view = VK_NULL_HANDLE;
  const VkResult result =
      device.vk().CreateImageView(device.handle(), &info, device.allocator(), &view);
  if (result < 0) return device.failVk(result, "vkCreateImageView", "image", image->name);
  image->view = view;
  device.setName(VK_OBJECT_TYPE_IMAGE_VIEW, handleNumber(view), image->name);
  return Status::Ok;
}

Status fill(Device& device, const Group& group, VkMemoryPropertyFlags properties,
            MemoryBlock* block) {
  const VkMemoryRequirements requirements =
      layOut(device, group, [](auto&, const VkMemoryRequirements&, VkDeviceSize) { return true; });
  uint32_t type = kNoType;
  Status status = chooseType(device, group, requirements.memoryTypeBits, properties, &type);
  if (status != Status::Ok) return status;
  const bool mustMap = (properties & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) != 0;
  const Request request = {group.name, requirements, type, mustMap};
  const MemoryHooks* hooks = device.memoryHooks();
  status = hooks != nullptr ? allocateFromHook(device, *hooks, request, block)
                            : allocateFromVulkan(device, request, block);
  if (status != Status::Ok) return status;
  status = bind(device, group, *block);
  for (uint32_t i = 0; i < group.imageCount && status == Status::Ok; ++i) {
    if (hasView(*group.images[i])) status = createView(device, group.images[i]);
  }
  return status;
}

}  // namespace

Status allocateAndBind(Device& device, const char* name, VkMemoryPropertyFlags properties,
                       Image* const* images, uint32_t imageCount, Buffer* const* buffers,
                       uint32_t bufferCount, MemoryBlock* out) {
  *out = MemoryBlock{};
  if (imageCount == 0 && bufferCount == 0) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "Memory block \"%s\" has nothing to hold, but an image or a buffer is "
                       "expected.",
                       name);
  }
  const Group group = {name, images, imageCount, buffers, bufferCount};
  MemoryBlock block;
  const Status status = fill(device, group, properties, &block);
  if (status == Status::Ok) {
    *out = block;
    return status;
  }
  for (uint32_t i = 0; i < imageCount; ++i) {
    device.destroyObject(VK_OBJECT_TYPE_IMAGE_VIEW, images[i]->view);
    images[i]->view = VK_NULL_HANDLE;
  }
  for (uint32_t i = 0; i < bufferCount; ++i) buffers[i]->mapped = nullptr;
  freeBlock(device, &block);
  return status;
}

void freeBlock(Device& device, MemoryBlock* block) {
  if (block->range.memory == VK_NULL_HANDLE) return;
  if (const MemoryHooks* hooks = device.memoryHooks()) {
    hooks->free(hooks->user, block->range);
  } else {
    if (block->mapped != nullptr) device.vk().UnmapMemory(device.handle(), block->range.memory);
    device.vk().FreeMemory(device.handle(), block->range.memory, device.allocator());
  }
  device.counters().removeBytes(block->size);
  *block = MemoryBlock{};
}

void deferBlock(Device& device, uint64_t frame, MemoryBlock* block) {
  device.deletions().defer(frame, *block);
  *block = MemoryBlock{};
}

}  // namespace alpenglow::engine
