// The host's device as all parts of the library use it: the function table, limits, error reports,
// counters, and the queue of deferred destruction.
#pragma once

#include <alpenglow/types.h>

#include <atomic>
#include <cstddef>
#include <mutex>
#include <type_traits>
#include <vector>

#include "engine/deletion_queue.h"
#include "engine/dispatch.h"
#include "engine/frames.h"
#include "engine/requirements.h"
#include "engine/result.h"

#if defined(__MINGW32__)  // The plain name means Microsoft's printf there, which lacks %zu.
#define ALPENGLOW_PRINTF(text, first) __attribute__((__format__(__gnu_printf__, text, first)))
#elif defined(__GNUC__)
#define ALPENGLOW_PRINTF(text, first) __attribute__((__format__(__printf__, text, first)))
#else
#define ALPENGLOW_PRINTF(text, first)
#endif

namespace alpenglow::engine {

/// A Vulkan handle as the 64-bit number that debug names and the deletion queue use.
template <class Handle>
uint64_t handleNumber(Handle handle) {
  if constexpr (std::is_pointer_v<Handle>) {
    return static_cast<uint64_t>(reinterpret_cast<uintptr_t>(handle));
  } else {
    return handle;
  }
}

/// And back.
template <class Handle>
Handle handleFrom(uint64_t number) {
  if constexpr (std::is_pointer_v<Handle>) {
    return reinterpret_cast<Handle>(static_cast<uintptr_t>(number));
  } else {
    return number;
  }
}

/// Lets the host replace SPIR-V of a shader: called with the shader's name, for each shader of each
/// pipeline that is made. True: `code`, `bytes` long, is used instead; it must live
/// until the pipeline is made.
struct ShaderReplacement {
  void* user = nullptr;
  bool (*replace)(void* user, const char* name, const uint32_t** code, size_t* bytes) = nullptr;
};

/// The host's device. Everything is the host's and outlives the Device; zero means none.
struct DeviceDesc {
  const char* name = "DeviceDesc";  ///< The host's name of this struct, for sentences. A literal.
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
  FeatureSet needed;   ///< Besides Vulkan 1.3 and synchronization2, which the engine needs itself.
  FeatureSet enabled;  ///< What the host really enabled.
  const uint32_t* queueFamilies = nullptr;  ///< Families that will use our images. Copied.
  uint32_t queueFamilyCount = 0;
  VkPipelineCache pipelineCache = VK_NULL_HANDLE;
  const VkAllocationCallbacks* allocator = nullptr;
  const MemoryHooks* memory = nullptr;         ///< Copied.
  const ShaderReplacement* shaders = nullptr;  ///< Copied.
  DiagnosticFn diagnostic = nullptr;
  void* user = nullptr;
  bool debugNames = false;  ///< The host enabled VK_EXT_debug_utils on the instance.
};

/// Counts of what was made and recorded on a device. The engine counts all but dispatches and
/// draws, which the recording code adds. Thread-safe.
struct Counters {
  std::atomic<uint64_t> pipelines{0};
  std::atomic<uint64_t> shaderVariants{0};
  std::atomic<uint64_t> images{0};
  std::atomic<uint64_t> buffers{0};
  std::atomic<uint64_t> bytes{0};
  std::atomic<uint64_t> peakBytes{0};
  std::atomic<uint64_t> dispatches{0};
  std::atomic<uint64_t> draws{0};
  std::atomic<uint64_t> lutUpdates{0}, lutsSkipped{0};
  std::atomic<uint64_t> shadowMapUpdates{0}, shadowMapsSkipped{0};

  void addBytes(uint64_t count);  ///< Raises peakBytes too.
  void removeBytes(uint64_t count) { bytes -= count; }
};

/// The host's device. Everything here is thread-safe. Made on the heap without the host's
/// allocation callbacks: those apply to Vulkan objects only.
class Device {
 public:
  /// Checks the description and fills the table. On failure `*out` is null and the description's
  /// diagnostic has a sentence: InvalidArgument for a null handle or an impossible count,
  /// Unsupported for a device made without what is needed, below Vulkan 1.3 or without a function
  /// that we need, OutOfHostMemory.
  static Status create(const DeviceDesc& desc, Device** out);
  /// The same with a table that is already filled; for tests.
  static Status create(const DeviceDesc& desc, const Dispatch& table, Device** out);
  /// Destroys all that is deferred, whatever its frame, and reports images, buffers and bytes that
  /// nobody released as a Warning. Null is ignored.
  static void destroy(Device* device);
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const Dispatch& vk() const { return vk_; }
  VkInstance instance() const { return desc_.instance; }
  VkPhysicalDevice physicalDevice() const { return desc_.physicalDevice; }
  VkDevice handle() const { return desc_.device; }
  const VkAllocationCallbacks* allocator() const { return desc_.allocator; }
  VkPipelineCache pipelineCache() const { return desc_.pipelineCache; }
  const FeatureSet& enabled() const { return desc_.enabled; }
  const MemoryHooks* memoryHooks() const { return hooks_.allocate != nullptr ? &hooks_ : nullptr; }
  const ShaderReplacement& shaderReplacement() const { return shaderReplacement_; }
  DiagnosticSink sink() const { return {desc_.diagnostic, desc_.user}; }
  /// The host's name of the description of this device.
  const char* descName() const { return desc_.name; }
  /// The families that share our images and buffers; more than one means concurrent.
  const std::vector<uint32_t>& queueFamilies() const { return queueFamilies_; }
  VkSharingMode sharingMode() const {
    return queueFamilies_.size() > 1 ? VK_SHARING_MODE_CONCURRENT : VK_SHARING_MODE_EXCLUSIVE;
  }
  const VkPhysicalDeviceLimits& limits() const { return properties_.limits; }
  const VkPhysicalDeviceProperties& properties() const { return properties_; }
  const VkPhysicalDeviceMemoryProperties& memoryProperties() const { return memoryProperties_; }
  VkFormatProperties formatProperties(VkFormat format) const;

  /// Sends one sentence (printf style, cut at 1023 bytes) as an Error to the diagnostic callback
  /// and returns `status`, so that `return device.fail(...)` reads naturally.
  Status fail(Status status, VkResult result, const char* format, ...) const ALPENGLOW_PRINTF(4, 5);
  /// Maps a VkResult: Ok for VK_SUCCESS and other non-negative results; else reports
  /// `<what> returned VK_ERROR_... (-2).`, where `what` is such as
  /// `vkCreateImage for image "scattering"`.
  Status failVk(VkResult result, const char* what) const;
  /// The same with `what` made of a call and the name of the thing it was for.
  Status failVk(VkResult result, const char* call, const char* kind, const char* name) const;
  /// A Warning or Info; the status is Ok.
  void notice(Severity severity, const char* format, ...) const ALPENGLOW_PRINTF(3, 4);

  /// VK_EXT_debug_utils names and labels; nothing happens when the host didn't enable it.
  void setName(VkObjectType type, uint64_t handle, const char* name) const;
  void beginLabel(VkCommandBuffer commandBuffer, const char* name) const;
  void endLabel(VkCommandBuffer commandBuffer) const;

  /// Destroys one object now and keeps the counters right. Knows images, image views, buffers,
  /// pipelines, pipeline layouts, shader modules, samplers, descriptor pools and set layouts. A
  /// null handle is ignored.
  void destroyObject(VkObjectType type, uint64_t handle);
  template <class Handle>
  void destroyObject(VkObjectType type, Handle handle) {
    destroyObject(type, handleNumber(handle));
  }

  DeletionQueue& deletions() { return deletions_; }
  FrameList& frames() { return frames_; }
  uint64_t submitting() const { return frames_.submitting(); }  ///< The frame that is recorded now.
  uint64_t completed() const { return frames_.completed(); }    ///< The newest that has finished.
  Counters& counters() { return counters_; }
  const Counters& counters() const { return counters_; }
  /// Counts a pipeline, and its shader variant when no pipeline had this key before.
  void countPipeline(uint64_t variantKey);

 private:
  Device(const DeviceDesc& desc, const Dispatch& table);
  ~Device() = default;
  void report(Severity severity, Status status, VkResult result, const char* message) const;

  DeviceDesc desc_;
  Dispatch vk_;
  MemoryHooks hooks_;
  ShaderReplacement shaderReplacement_;
  std::vector<uint32_t> queueFamilies_;
  VkPhysicalDeviceProperties properties_ = {};
  VkPhysicalDeviceMemoryProperties memoryProperties_ = {};
  Counters counters_;
  FrameList frames_;
  DeletionQueue deletions_;
  std::mutex variantsMutex_;
  std::vector<uint64_t> variants_;  ///< Sorted keys.
};

}  // namespace alpenglow::engine
