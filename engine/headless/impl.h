// Members of a headless device.
#pragma once

#include <alpenglow/headless.h>

#include "engine/headless/selection.h"

namespace alpenglow::headless {

struct Device::Impl {
  std::unique_ptr<Instance> instance;
  Selection selection;
  std::string name;
  float timestampPeriod = 0.0f;  ///< Nanoseconds a tick.
  VkPhysicalDeviceMemoryProperties memory = {};
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool commandPool = VK_NULL_HANDLE;
  VkCommandBuffer commandBuffer = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  VkQueryPool queries = VK_NULL_HANDLE;  ///< Two timestamps; null when the queue has none.
  uint64_t completedFrame = 0;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl();  ///< Destroys what was made, in whatever state creation stopped.

  const Functions& vk() const { return instance->vk(); }
  bool createDevice(const DeviceOptions& options, std::string* error);
  bool createCommands(std::string* error);
  bool submitAndWait(std::string* error, Timing* timing);
  double gpuSeconds() const;
  /// The memory type with all of `required`, and `preferred` too where there is one; UINT32_MAX
  /// when none.
  uint32_t memoryType(uint32_t typeBits, VkMemoryPropertyFlags required,
                      VkMemoryPropertyFlags preferred) const;
  /// False, with a sentence, when there is no such memory.
  bool allocate(const VkMemoryRequirements& requirements, VkMemoryPropertyFlags required,
                VkMemoryPropertyFlags preferred, VkDeviceMemory* out, std::string* error) const;
};

}  // namespace alpenglow::headless
