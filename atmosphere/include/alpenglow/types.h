// What every header shares: status codes, diagnostics, images of the host's and of ours, memory
// hooks. Plain types: no STL, no exceptions, no RTTI, no global state. Zero is the default of every
// member of every struct of this library, so `{}` is always a valid description.
#pragma once

#include <alpenglow/export.h>
#include <vulkan/vulkan_core.h>

#include <cstddef>
#include <cstdint>

namespace alpenglow {
inline namespace v1_0 {

/// Result of every call that can fail. Ok is 0, so `if (status != Status::Ok)` reads naturally.
enum class Status : int32_t {
  Ok = 0,
  NotReady,         ///< Tables are not baked, or beginFrame of this frame failed. Not an error: no
                    ///< sentence is reported.
  InvalidArgument,  ///< The caller's values are wrong; the object is as it was before the call.
  Unsupported,      ///< The device, its enabled features or this version can't do what was asked.
  OutOfHostMemory,  ///< VK_ERROR_OUT_OF_HOST_MEMORY, or an allocation of the library failed.
  OutOfDeviceMemory,  ///< VK_ERROR_OUT_OF_DEVICE_MEMORY, or the host's memory hook refused.
  DeviceLost,         ///< VK_ERROR_DEVICE_LOST; destroying objects stays legal.
  VulkanError,        ///< Any other VkResult below zero; Diagnostic::result has it.
};

/// "InvalidArgument", ... Never null.
ALPENGLOW_API const char* statusName(Status status);

enum class Severity : int32_t { Info, Warning, Error };

/// One report: a full sentence that names the value given and what was expected.
struct Diagnostic {
  Severity severity = Severity::Info;
  Status status = Status::Ok;
  VkResult result = VK_SUCCESS;   ///< VK_SUCCESS where Vulkan was not asked.
  const char* message = nullptr;  ///< Never null in a report; valid during the call.
};

/// Called on the thread that made the failing call; the library starts no threads.
using DiagnosticFn = void (*)(void* user, const Diagnostic& diagnostic);

/// Where sentences go. Calls on a context or its objects use the context's sink; other functions
/// take one. A null `report` discards them. Every failing call reports one Error. A warning is
/// reported once for each object.
struct DiagnosticSink {
  DiagnosticFn report = nullptr;
  void* user = nullptr;
};

/// An image of the host's. It stays the host's and lives until the frames that use it have
/// completed.
struct HostImage {
  VkImageView view = VK_NULL_HANDLE;                 ///< Null: none.
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;  ///< While our commands execute; 0: the default
                                                     ///< that the member's comment names.
  VkExtent2D extent = {};                            ///< Texels of level 0.
  VkSampler sampler = VK_NULL_HANDLE;                ///< Only where the member's comment says so.
};

/// An image of ours, in the state in which the last recorded call leaves it: `layout`, written by
/// `stage` and `access`, and already made visible to the reader stages of its owner, so that a
/// later reader on the same queue needs no barrier.
struct ImageInfo {
  const char* name = nullptr;  ///< Static. Null: this object has no such image.
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkExtent3D extent = {};
  uint64_t bytes = 0;  ///< Of a tightly packed copy.
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 access = VK_ACCESS_2_NONE;
};

/// A box of any orientation, in world units and axes.
struct Box {
  double center[3] = {};
  double halfExtents[3] = {};
  /// Orthonormal directions of the three half extents; 0: the world's axes.
  double axes[3][3] = {};
};

/// A range of device memory from the host's hook.
struct MemoryRange {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;
  void* mapped = nullptr;  ///< First byte of the range, where it is mapped.
};

/// Optional: the host's allocator (VMA or its own) serves our few memory blocks. Both functions
/// must be thread-safe. Ranges may share a VkDeviceMemory: memory of a hook is never mapped or
/// unmapped here. A host that sub-allocates keeps bufferImageGranularity between ranges with images
/// and ranges with buffers (those asked for with `mustMap` hold buffers only).
struct MemoryHooks {
  void* user = nullptr;
  /// Fills `range` with memory of type `memoryTypeIndex`, at least `requirements.size` bytes, at a
  /// multiple of `requirements.alignment`. With `mustMap` the type is host-visible and coherent,
  /// and the range stays mapped until it is freed. `name` says what the memory is for.
  VkResult (*allocate)(void* user, const VkMemoryRequirements& requirements,
                       uint32_t memoryTypeIndex, bool mustMap, const char* name,
                       MemoryRange* range) = nullptr;
  /// Takes back `range` as `allocate` filled it, also one that was refused for what it holds.
  void (*free)(void* user, const MemoryRange& range) = nullptr;
};

}  // namespace v1_0
}  // namespace alpenglow
