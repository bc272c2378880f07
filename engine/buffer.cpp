#include "engine/buffer.h"

#include "engine/structure.h"

namespace alpenglow::engine {

Status createBuffer(Device& device, VkDeviceSize size, VkBufferUsageFlags usage, const char* name,
                    Buffer* out) {
  *out = Buffer{};
  if (size == 0 || usage == 0) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "Buffer \"%s\" has %llu bytes and usage 0x%x, but neither may be 0.", name,
                       static_cast<unsigned long long>(size), usage);
  }
  auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = size;
  info.usage = usage;
  info.sharingMode = device.sharingMode();
  if (info.sharingMode == VK_SHARING_MODE_CONCURRENT) {
    info.queueFamilyIndexCount = static_cast<uint32_t>(device.queueFamilies().size());
    info.pQueueFamilyIndices = device.queueFamilies().data();
  }
  VkBuffer handle = VK_NULL_HANDLE;
  const VkResult result =
      device.vk().CreateBuffer(device.handle(), &info, device.allocator(), &handle);
  if (result < 0) return device.failVk(result, "vkCreateBuffer", "buffer", name);

  ++device.counters().buffers;
  out->handle = handle;
  out->size = size;
  device.setName(VK_OBJECT_TYPE_BUFFER, handleNumber(handle), name);
  return Status::Ok;
}

void destroyBuffer(Device& device, Buffer* buffer) {
  device.destroyObject(VK_OBJECT_TYPE_BUFFER, buffer->handle);
  *buffer = Buffer{};
}

void deferBuffer(Device& device, uint64_t frame, Buffer* buffer) {
  device.deletions().defer(frame, VK_OBJECT_TYPE_BUFFER, handleNumber(buffer->handle));
  *buffer = Buffer{};
}

}  // namespace alpenglow::engine
