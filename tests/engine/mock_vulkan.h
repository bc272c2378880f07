// A Vulkan of the tests' own: a table that records calls, hands out numbered handles, knows what is
// alive, and fails where a test asks for it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/device.h"

namespace alpenglow::testing {

/// One at a time: Vulkan's functions carry no user pointer, so they find it by a global.
class MockVulkan {
 public:
  MockVulkan();
  ~MockVulkan();
  MockVulkan(const MockVulkan&) = delete;
  MockVulkan& operator=(const MockVulkan&) = delete;
  static MockVulkan& current();

  /// A device on this Vulkan, diagnostics recorded; the test destroys it.
  engine::Device* makeDevice();
  /// A description that passes every check.
  engine::DeviceDesc deviceDesc();
  engine::Dispatch table() const;

  // What the device is like; to be changed before a call.
  VkPhysicalDeviceProperties properties = {};
  VkPhysicalDeviceFeatures features = {};
  uint32_t loaderVersion = VK_API_VERSION_1_3;
  bool synchronization2 = true;
  bool dynamicRendering = true;
  VkPhysicalDeviceMemoryProperties memory = {};
  VkFormatFeatureFlags formatFeatures = ~VkFormatFeatureFlags{0};
  VkExtent3D maxExtent = {16384, 16384, 2048};
  std::vector<VkMemoryRequirements> imageRequirements;   ///< Of the N-th image; the last repeats.
  std::vector<VkMemoryRequirements> bufferRequirements;  ///< Likewise.
  std::string missingFunction;  ///< vkGet*ProcAddr answers null for this name.

  // Failing: the call with this number (from 0, of those that can fail) returns failWith.
  int failAt = -1;
  VkResult failWith = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  int fallibleCalls = 0;
  std::string failedCall;

  // What happened.
  std::vector<std::string> calls;
  std::map<uint64_t, std::string> alive;  ///< Handle to kind: "Image", "DeviceMemory", ...
  std::vector<std::string> destroyed;     ///< Kinds, in order.
  std::vector<std::string> mistakes;      ///< A destroy of what isn't alive, a foreign allocator.
  std::vector<VkImageMemoryBarrier2> imageBarriers;  ///< Of the last vkCmdPipelineBarrier2.
  std::vector<VkMemoryBarrier2> memoryBarriers;
  struct Binding {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
  };
  std::vector<Binding> bindings;  ///< In call order, images and buffers.
  std::vector<VkMemoryAllocateInfo> allocations;
  std::vector<VkImageCreateInfo> imageInfos;
  std::vector<VkDescriptorPoolSize> poolSizes;  ///< Of the last pool.
  uint32_t poolSets = 0;
  std::vector<VkWriteDescriptorSet> descriptorWrites;
  std::vector<std::string> diagnostics;
  std::vector<Diagnostic> diagnosticValues;          ///< Their messages are gone.
  std::vector<std::byte> mapped;                     ///< What vkMapMemory hands out.
  const VkAllocationCallbacks* allocator = nullptr;  ///< The only one that calls may carry.

  int count(const std::string& call) const;
  int aliveCount(const std::string& kind) const;
  const std::string& lastDiagnostic() const;

  // For the table's functions.
  VkResult attempt(const char* call);  ///< Counts a call that can fail.
  uint64_t make(const char* kind, const VkAllocationCallbacks* with);
  void unmake(const char* kind, uint64_t handle, const VkAllocationCallbacks* with);

 private:
  void checkAllocator(const char* what, const VkAllocationCallbacks* with);
  uint64_t nextHandle_ = 1000;
  std::map<uint64_t, void*> hostMemory_;  ///< From the allocation callbacks, by handle.
};

}  // namespace alpenglow::testing
