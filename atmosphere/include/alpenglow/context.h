// A context on a Vulkan device that the host made. The library never creates a device, submits,
// waits or starts a thread, and reaches Vulkan only through the host's vkGetInstanceProcAddr.
#pragma once

#include <alpenglow/types.h>

#include <cstddef>

namespace alpenglow {
inline namespace v1 {

struct Context;  ///< Opaque.

/// What the host wants to do. Bits; ask for what you use, each has its own requirements.
enum Capability : uint32_t {
  kCapabilityBake = 1u << 0,           ///< Compute shaders that fill the tables, and probe queries.
  kCapabilitySky = 1u << 1,            ///< Graphics pipelines that draw sky and ground.
  kCapabilityAir = 1u << 2,            ///< Aerial perspective over a host's scene: dualSrcBlend.
  kCapabilityShafts = 1u << 3,         ///< Light shafts: depthClamp.
  kCapabilityShadowVolumes = 1u << 4,  ///< ShaftMethod::Paper, with kCapabilityShafts:
                                       ///< geometryShader, shaderClipDistance, independentBlend.
};
using CapabilityFlags = uint32_t;

/// What a device must offer, asked before the host makes its VkDevice.
struct Requirements {
  uint32_t apiVersion = 0;        ///< Least VkApplicationInfo::apiVersion and device version.
  bool synchronization2 = false;  ///< VkPhysicalDeviceVulkan13Features::synchronization2.
  bool dynamicRendering = false;  ///< Likewise; for shafts, and views that name no VkRenderPass.
  VkPhysicalDeviceFeatures features = {};  ///< Core features that must be enabled.
};

/// Fills `out` with what `wanted` needs, and checks that `physicalDevice` has it. When it has not,
/// returns Unsupported and reports a sentence naming every gap to `diagnostic` (may be null).
/// Thread-safe.
ALPENGLOW_API Status queryRequirements(PFN_vkGetInstanceProcAddr getInstanceProcAddr,
                                       VkInstance instance, VkPhysicalDevice physicalDevice,
                                       CapabilityFlags wanted, Requirements* out,
                                       DiagnosticFn diagnostic, void* user);

/// Lets a host put SPIR-V of its own in place of a shader of ours: docs/shaders.md.
struct ShaderHook {
  void* user = nullptr;
  /// Asked for each shader of each pipeline, when it is made: by createTables, recordBake,
  /// createView, createShafts, recordProbe. `name` is the shader's in shaders.json, such as
  /// "kSkyFragmentSlice". True: `code`, `bytes` long, is used instead; it must live until the call
  /// that asked returns. Null with false. Code that declares a resource that ours doesn't, or is of
  /// another stage or group size, makes that call fail with InvalidArgument. Called from the thread
  /// that made the call. Tables and views keep the pipelines that they have: make them anew to use
  /// other code. Those of recordProbe stay with the context.
  bool (*replace)(void* user, const char* name, const uint32_t** code, size_t* bytes) = nullptr;
};

/// Everything is the host's and outlives the context; zero means none or the default.
struct ContextDesc {
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
  CapabilityFlags capabilities = 0;         ///< 0: bake and sky, which every device has.
  Requirements enabled;                     ///< What the host really enabled on its device.
  const uint32_t* queueFamilies = nullptr;  ///< Families that will touch our images.
  uint32_t queueFamilyCount = 0;            ///< More than one makes images concurrent.
  VkPipelineCache pipelineCache = VK_NULL_HANDLE;
  const VkAllocationCallbacks* allocator = nullptr;
  const MemoryHooks* memory = nullptr;  ///< Copied.
  const ShaderHook* shaders = nullptr;  ///< Copied.
  DiagnosticFn diagnostic = nullptr;
  void* user = nullptr;
  bool debugNames = false;  ///< The host enabled VK_EXT_debug_utils on the instance.
};

/// Makes a context. Its functions are thread-safe; objects made on it (tables, views) are
/// externally synchronised, and different ones may be recorded in parallel.
ALPENGLOW_API Status createContext(const ContextDesc& desc, Context** out);

/// Destroys the context and what still waits for a frame. The host guarantees that the GPU is done
/// with it. Tables and views left alive are reported through the diagnostic callback, how many of
/// each, and are lost: they must not be destroyed afterwards.
ALPENGLOW_API void destroyContext(Context* context);

/// Destroys what frames up to `completed` used and destroyed objects left behind.
ALPENGLOW_API void collect(Context* context, uint64_t completed);

/// What the context holds now; for reports and tests. Counters only ever rise, except `bytes`,
/// `images` and `buffers`, which are what is alive.
struct ResourceReport {
  uint64_t pipelines = 0;       ///< Made since the context was made.
  uint64_t shaderVariants = 0;  ///< Different (SPIR-V, specialization) pairs among them.
  uint64_t images = 0;
  uint64_t buffers = 0;
  uint64_t bytes = 0;  ///< Device memory, from our blocks or the host's hook.
  uint64_t peakBytes = 0;
  uint64_t dispatches = 0;
  uint64_t draws = 0;
};
ALPENGLOW_API void resourceReport(const Context* context, ResourceReport* out);

}  // namespace v1
}  // namespace alpenglow
