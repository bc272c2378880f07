// The Vulkan functions that a headless device calls itself, from a loader opened at run time.
#pragma once

#include <vulkan/vulkan_core.h>

namespace alpenglow::headless {

// clang-format off
#define ALPENGLOW_HEADLESS_GLOBAL_FUNCTIONS(X) \
  X(CreateInstance) X(EnumerateInstanceExtensionProperties) X(EnumerateInstanceLayerProperties) \
  X(EnumerateInstanceVersion)

#define ALPENGLOW_HEADLESS_INSTANCE_FUNCTIONS(X) \
  X(CreateDevice) X(DestroyInstance) X(EnumerateDeviceExtensionProperties) \
  X(EnumeratePhysicalDevices) X(GetDeviceProcAddr) \
  X(GetPhysicalDeviceFeatures2) X(GetPhysicalDeviceMemoryProperties) \
  X(GetPhysicalDeviceProperties) X(GetPhysicalDeviceQueueFamilyProperties)

#define ALPENGLOW_HEADLESS_DEBUG_FUNCTIONS(X) \
  X(CreateDebugUtilsMessengerEXT) X(DestroyDebugUtilsMessengerEXT)

#define ALPENGLOW_HEADLESS_DEVICE_FUNCTIONS(X) \
  X(AllocateCommandBuffers) X(AllocateMemory) X(BeginCommandBuffer) X(BindBufferMemory) \
  X(BindImageMemory) X(CmdResetQueryPool) X(CmdWriteTimestamp) X(CreateBuffer) \
  X(CreateCommandPool) X(CreateFence) X(CreateImage) X(CreateImageView) X(CreateQueryPool) \
  X(DestroyBuffer) X(DestroyCommandPool) X(DestroyDevice) X(DestroyFence) X(DestroyImage) \
  X(DestroyImageView) X(DestroyQueryPool) X(DeviceWaitIdle) X(EndCommandBuffer) X(FreeMemory) \
  X(GetBufferMemoryRequirements) X(GetDeviceQueue) X(GetImageMemoryRequirements) \
  X(GetQueryPoolResults) X(MapMemory) X(QueueSubmit) X(ResetCommandPool) X(ResetFences) \
  X(WaitForFences)
// clang-format on

/// Named as in Vulkan without the prefix. Each load returns null, or the name of a function that
/// can't be found.
struct Functions {
#define ALPENGLOW_MEMBER(name) PFN_vk##name name = nullptr;
  ALPENGLOW_HEADLESS_GLOBAL_FUNCTIONS(ALPENGLOW_MEMBER)
  ALPENGLOW_HEADLESS_INSTANCE_FUNCTIONS(ALPENGLOW_MEMBER)
  ALPENGLOW_HEADLESS_DEBUG_FUNCTIONS(ALPENGLOW_MEMBER)
  ALPENGLOW_HEADLESS_DEVICE_FUNCTIONS(ALPENGLOW_MEMBER)
#undef ALPENGLOW_MEMBER

  const char* loadGlobal(PFN_vkGetInstanceProcAddr get) {
#define ALPENGLOW_LOAD(name)                                              \
  name = reinterpret_cast<PFN_vk##name>(get(VK_NULL_HANDLE, "vk" #name)); \
  if (name == nullptr) return "vk" #name;
    ALPENGLOW_HEADLESS_GLOBAL_FUNCTIONS(ALPENGLOW_LOAD)
#undef ALPENGLOW_LOAD
    return nullptr;
  }

  const char* loadInstance(PFN_vkGetInstanceProcAddr get, VkInstance instance, bool debugUtils) {
#define ALPENGLOW_LOAD(name)                                        \
  name = reinterpret_cast<PFN_vk##name>(get(instance, "vk" #name)); \
  if (name == nullptr) return "vk" #name;
    ALPENGLOW_HEADLESS_INSTANCE_FUNCTIONS(ALPENGLOW_LOAD)
    if (debugUtils) {
      ALPENGLOW_HEADLESS_DEBUG_FUNCTIONS(ALPENGLOW_LOAD)
    }
#undef ALPENGLOW_LOAD
    return nullptr;
  }

  const char* loadDevice(VkDevice device) {
#define ALPENGLOW_LOAD(name)                                                    \
  name = reinterpret_cast<PFN_vk##name>(GetDeviceProcAddr(device, "vk" #name)); \
  if (name == nullptr) return "vk" #name;
    ALPENGLOW_HEADLESS_DEVICE_FUNCTIONS(ALPENGLOW_LOAD)
#undef ALPENGLOW_LOAD
    return nullptr;
  }
};

}  // namespace alpenglow::headless
