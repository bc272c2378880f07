// A context on a Vulkan device that the host made. The library never creates a device, submits,
// waits or starts a thread, and reaches Vulkan only through the host's vkGetInstanceProcAddr.
#pragma once

#include <alpenglow/types.h>

namespace alpenglow {
inline namespace v1_0 {

/// Opaque. Internally synchronised: functions that take a Context may be called from any thread at
/// any time, except that host access to the Context must be externally synchronised in
/// destroyContext, and host access to it and to every object made on it in advanceFrame and
/// abandonFrame.
struct Context;

/// What the host wants to do. Bits; ask only for what you use: each has its own requirements.
enum Capability : uint32_t {
  kCapabilityBake = 1u << 0,  ///< Compute shaders that fill the tables, and probe queries.
  kCapabilitySky = 1u << 1,   ///< Graphics pipelines that draw sky and ground.
  /// Aerial perspective over a host's scene. Needs dualSrcBlend.
  kCapabilityAerialPerspective = 1u << 2,
  kCapabilityLightShafts = 1u << 3,  ///< Light shafts. Need depthClamp.
  /// LightShaftMethod::ShadowVolume. Needs kCapabilityLightShafts, geometryShader,
  /// shaderClipDistance and independentBlend.
  kCapabilityShadowVolumes = 1u << 4,
};
using CapabilityFlags = uint32_t;

/// Device features beyond VkPhysicalDeviceFeatures that the library uses.
enum DeviceFeature : uint32_t {
  kFeatureSynchronization2 = 1u << 0,  ///< VkPhysicalDeviceVulkan13Features::synchronization2.
  kFeatureDynamicRendering = 1u << 1,  ///< Likewise; for light shafts, and views without a
                                       ///< VkRenderPass.
};
using DeviceFeatureFlags = uint32_t;

/// What a device must offer and a host must enable.
struct Requirements {
  uint32_t apiVersion = 0;           ///< Least VkApplicationInfo::apiVersion and device version.
  CapabilityFlags capabilities = 0;  ///< Of those asked for, the ones that this device has.
  DeviceFeatureFlags deviceFeatures = 0;
  VkPhysicalDeviceFeatures features = {};  ///< Core features that must be enabled.
};

/// Lets a host put SPIR-V of its own in place of a shader of ours: docs/shaders.md.
struct ShaderHook {
  void* user = nullptr;
  /// Called for each shader of each pipeline that is made: by createTables, recordBake,
  /// createView, recordProbe. `name` is the shader's in shaders.json, such as
  /// "kSkyFragmentLut". True: `code`, `bytes` long, is used instead; it must live until that
  /// call returns. False: the library's own shader is used. Code that declares a resource that ours
  /// doesn't, or is of another stage or group size, makes that call fail with InvalidArgument.
  /// Called from the thread that made the call. Tables and views keep the pipelines that they have:
  /// recreate them to use other code. Those of recordProbe stay with the context.
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
  const uint32_t* queueFamilies = nullptr;  ///< Families that will use our images.
  uint32_t queueFamilyCount = 0;            ///< Above 1: images have concurrent sharing mode.
  /// Stages of the host's shaders that bind our descriptor sets; 0: compute and fragment, which are
  /// always among them.
  VkShaderStageFlags setStages = 0;
  VkPipelineCache pipelineCache = VK_NULL_HANDLE;
  const VkAllocationCallbacks* allocator = nullptr;
  MemoryHooks memory;  ///< Copied. All zero: none.
  ShaderHook shaders;  ///< Copied. All zero: none.
  DiagnosticSink diagnostics;
  bool debugNames = false;  ///< The host enabled VK_EXT_debug_utils on the instance.
};

/// Before vkCreateDevice. Reads instance, physicalDevice, getInstanceProcAddr, capabilities and
/// diagnostics of `desc`, and fills `out`. Unsupported, with a sentence that names every gap, where
/// the device lacks a capability; `out` then holds what the remaining capabilities need, and may be
/// used with them. A device or instance below Vulkan 1.3 is named as the reason where it is.
/// Thread-safe.
ALPENGLOW_API Status queryRequirements(const ContextDesc& desc, Requirements* out);

/// Makes a context. `*out` is null on failure.
ALPENGLOW_API Status createContext(const ContextDesc& desc, Context** out);

/// The device must have finished with everything of the context. Tables and views that are alive
/// are destroyed, too: they must not be used afterwards. Null is ignored, as by every destroy
/// function.
ALPENGLOW_API void destroyContext(Context* context);

/// States the frame numbers of all other calls; once a frame, before anything of the frame is
/// recorded or destroyed. `submitting` is the frame being recorded (from 1), `completed` the newest
/// frame that has finished on every queue (0: none). Neither ever falls, and completed <=
/// submitting; else InvalidArgument with a sentence, and the numbers stay. What a destroy function
/// marks in frame n is freed by the first advanceFrame whose `completed` is at least n. Without any
/// call the frame is 1. A host that waits for each frame passes (n + 1, n).
ALPENGLOW_API Status advanceFrame(Context* context, uint64_t submitting, uint64_t completed);

/// The commands recorded in `frame` (above the completed one) will never execute, for example
/// because the swapchain was lost: call it before the next frame is recorded. LUTs, shadow maps,
/// uploads and bake slices of that frame count as not recorded. A bake continues before that
/// frame's first slice; from the start if slices of later frames were recorded.
ALPENGLOW_API Status abandonFrame(Context* context, uint64_t frame);

/// What the context holds now; for reports and tests. Counters only ever rise, except `bytes`,
/// `images` and `buffers`, which count what exists.
struct ResourceReport {
  uint64_t pipelines = 0;       ///< Made since the context was made.
  uint64_t shaderVariants = 0;  ///< Different (SPIR-V, specialization) pairs among them.
  uint64_t images = 0;
  uint64_t buffers = 0;
  uint64_t bytes = 0;  ///< Device memory, from our blocks or the host's hook.
  uint64_t peakBytes = 0;
  uint64_t dispatches = 0;
  uint64_t draws = 0;
  /// Calls of recordLuts and recordShadowMap that recorded, and that found nothing to do.
  uint64_t lutUpdates = 0, lutsSkipped = 0;
  uint64_t shadowMapUpdates = 0, shadowMapsSkipped = 0;
};
ALPENGLOW_API void resourceReport(const Context* context, ResourceReport* out);

}  // namespace v1_0
}  // namespace alpenglow
