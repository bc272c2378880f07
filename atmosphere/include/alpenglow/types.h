// The vocabulary that every part of Alpenglow shares: status codes, diagnostics, image states,
// frame numbers and memory hooks. Plain types only: no STL, no exceptions, no global state.
#pragma once

#include <alpenglow/export.h>

#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace alpenglow {
inline namespace v1 {

/// Result of every call that can fail. Ok is 0, so `if (status != Status::Ok)` reads naturally.
enum class Status : int32_t {
  Ok = 0,
  NotReady,           ///< The tables are not baked yet, or the queried copy has not arrived.
  InvalidArgument,    ///< The caller's values are wrong; the object is as it was before the call.
  Unsupported,        ///< The device, its enabled features or this version can't do what was asked.
  OutOfHostMemory,    ///< VK_ERROR_OUT_OF_HOST_MEMORY, or our own allocation failed.
  OutOfDeviceMemory,  ///< VK_ERROR_OUT_OF_DEVICE_MEMORY, or the host's memory hook refused.
  DeviceLost,         ///< VK_ERROR_DEVICE_LOST; destroying objects stays legal.
  VulkanError,        ///< Any other VkResult below zero; Diagnostic::result has it.
};

/// One line of English for people: "InvalidArgument", ... Never null.
ALPENGLOW_API const char* statusName(Status status);

enum class Severity : int32_t { Info, Warning, Error };

/// What a failed call reports. `message` is one full sentence that names the value given and what
/// was expected; it is valid only during the callback.
struct Diagnostic {
  Severity severity = Severity::Error;
  Status status = Status::Ok;
  VkResult result = VK_SUCCESS;  ///< The raw Vulkan result, VK_SUCCESS where Vulkan was not asked.
  const char* message = "";
};

/// Called from the thread that made the failing call, never from a thread of ours (we start none).
using DiagnosticFn = void (*)(void* user, const Diagnostic& diagnostic);

/// Rising numbers from the host's timeline semaphore or fences. `submitting` is the frame being
/// recorded now, `completed` the newest frame that the GPU has finished. What a frame may still
/// use is destroyed once `completed` reaches its number. Count from 1: frame 0 has always
/// completed.
struct FrameInfo {
  uint64_t submitting = 0;
  uint64_t completed = 0;
};

/// Real Vulkan stages, accesses and layouts of an image at one point of a command buffer.
struct ImageState {
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
  VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
  VkAccessFlags2 access = VK_ACCESS_2_NONE;
};

/// A range of device memory handed out by the host's hook.
struct MemoryRange {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;
  void* mapped = nullptr;  ///< The range's first byte (the one at `offset`) where it is mapped.
};

/// Optional: lets a host's allocator (VMA, its own) serve our few memory blocks. Both functions
/// must be thread-safe. Ranges may share a VkDeviceMemory: we never map or unmap memory of a hook.
/// A range may hold images: a host that sub-allocates keeps bufferImageGranularity between it and
/// ranges with buffers (those asked for with `mustMap` hold nothing else).
struct MemoryHooks {
  void* user = nullptr;
  /// Fills `range` with memory of type `memoryTypeIndex`, at least `requirements.size` bytes, at a
  /// multiple of `requirements.alignment`. With `mustMap` the type is host-visible and coherent,
  /// and the host sets `range->mapped` and keeps the range mapped until it is freed; a null
  /// `mapped` is then InvalidArgument. Without `mustMap`, `mapped` is ignored. `name` says what it
  /// is for.
  VkResult (*allocate)(void* user, const VkMemoryRequirements& requirements,
                       uint32_t memoryTypeIndex, bool mustMap, const char* name,
                       MemoryRange* range) = nullptr;
  /// Takes back `range` as `allocate` filled it, also one that was refused for what it holds.
  void (*free)(void* user, const MemoryRange& range) = nullptr;
};

}  // namespace v1
}  // namespace alpenglow
