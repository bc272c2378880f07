// A host whose Vulkan can be interfered with: getInstanceProcAddr for ContextDesc that hands out
// functions which call the real ones, but count, fail or change what they were asked for.
#pragma once

#include <alpenglow/headless.h>

#include <map>
#include <string>

namespace alpenglow::testing {

/// Vulkan's functions carry no user pointer, so they find it by a global: the newest one that lives
/// hears of all calls.
class VulkanWrap {
 public:
  explicit VulkanWrap(PFN_vkGetInstanceProcAddr real);
  ~VulkanWrap();
  VulkanWrap(const VulkanWrap&) = delete;
  VulkanWrap& operator=(const VulkanWrap&) = delete;

  /// For ContextDesc; works while this object lives.
  PFN_vkGetInstanceProcAddr getInstanceProcAddr() const;

  /// The call with this number (from 0, of those that can fail) returns `failWith`; none if < 0.
  int failAt = -1;
  VkResult failWith = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  int fallibleCalls = 0;
  std::string failedCall;
  std::map<std::string, int> calls;  ///< Of the functions that can fail, by name.

  /// Specialization constants that new graphics pipelines get instead of what was asked for.
  std::map<uint32_t, uint32_t> forcedConstants;
  /// Fragment shader of new graphics pipelines, if not null.
  VkShaderModule forcedFragment = VK_NULL_HANDLE;

  // For the functions that it hands out.
  bool failsNow(const char* name);
  PFN_vkGetInstanceProcAddr realGetInstanceProcAddr = nullptr;
  PFN_vkGetDeviceProcAddr realGetDeviceProcAddr = nullptr;

 private:
  VulkanWrap* previous_ = nullptr;
};

}  // namespace alpenglow::testing
