// The private function table: every Vulkan function that the library calls, filled through the
// host's vkGetInstanceProcAddr, so that no archive of ours defines or imports a vk* symbol.
#pragma once

#include <vulkan/vulkan_core.h>

namespace alpenglow::engine {

// clang-format off
/// Found with vkGetInstanceProcAddr(instance, ...).
#define ALPENGLOW_INSTANCE_FUNCTIONS(X) \
  X(GetDeviceProcAddr)                  \
  X(GetPhysicalDeviceFeatures2)         \
  X(GetPhysicalDeviceFormatProperties)  \
  X(GetPhysicalDeviceImageFormatProperties) \
  X(GetPhysicalDeviceMemoryProperties)  \
  X(GetPhysicalDeviceProperties)

/// Found with vkGetDeviceProcAddr(device, ...), so calls skip the loader.
#define ALPENGLOW_DEVICE_FUNCTIONS(X) \
  X(AllocateDescriptorSets)           \
  X(AllocateMemory)                   \
  X(BindBufferMemory)                 \
  X(BindImageMemory)                  \
  X(CmdBeginRendering)                \
  X(CmdBindDescriptorSets)            \
  X(CmdBindIndexBuffer)               \
  X(CmdBindPipeline)                  \
  X(CmdBindVertexBuffers)             \
  X(CmdBlitImage)                     \
  X(CmdClearColorImage)               \
  X(CmdCopyBuffer)                    \
  X(CmdCopyBufferToImage)             \
  X(CmdCopyImage)                     \
  X(CmdCopyImageToBuffer)             \
  X(CmdDispatch)                      \
  X(CmdDraw)                          \
  X(CmdDrawIndexed)                   \
  X(CmdDrawIndirect)                  \
  X(CmdEndRendering)                  \
  X(CmdFillBuffer)                    \
  X(CmdPipelineBarrier2)              \
  X(CmdPushConstants)                 \
  X(CmdSetScissor)                    \
  X(CmdSetViewport)                   \
  X(CmdUpdateBuffer)                  \
  X(CreateBuffer)                     \
  X(CreateComputePipelines)           \
  X(CreateDescriptorPool)             \
  X(CreateDescriptorSetLayout)        \
  X(CreateGraphicsPipelines)          \
  X(CreateImage)                      \
  X(CreateImageView)                  \
  X(CreatePipelineLayout)             \
  X(CreateSampler)                    \
  X(CreateShaderModule)               \
  X(DestroyBuffer)                    \
  X(DestroyDescriptorPool)            \
  X(DestroyDescriptorSetLayout)       \
  X(DestroyImage)                     \
  X(DestroyImageView)                 \
  X(DestroyPipeline)                  \
  X(DestroyPipelineLayout)            \
  X(DestroySampler)                   \
  X(DestroyShaderModule)              \
  X(FreeMemory)                       \
  X(GetBufferMemoryRequirements)      \
  X(GetImageMemoryRequirements)       \
  X(MapMemory)                        \
  X(UnmapMemory)                      \
  X(UpdateDescriptorSets)

/// VK_EXT_debug_utils: null when the host didn't enable it.
#define ALPENGLOW_OPTIONAL_FUNCTIONS(X) \
  X(SetDebugUtilsObjectNameEXT)         \
  X(CmdBeginDebugUtilsLabelEXT)         \
  X(CmdEndDebugUtilsLabelEXT)
// clang-format on

/// One pointer per function, named as in Vulkan without its prefix: `vk.CmdDispatch(...)`. A plain
/// struct, so that tests can replace entries with recorders or with functions that fail.
struct Dispatch {
#define ALPENGLOW_MEMBER(name) PFN_vk##name name = nullptr;
  ALPENGLOW_INSTANCE_FUNCTIONS(ALPENGLOW_MEMBER)
  ALPENGLOW_DEVICE_FUNCTIONS(ALPENGLOW_MEMBER)
  ALPENGLOW_OPTIONAL_FUNCTIONS(ALPENGLOW_MEMBER)
#undef ALPENGLOW_MEMBER

  /// Fills the instance functions, and with a device also the others. False when one that is not
  /// optional can't be found; `missing` (may be null) then names the first, for instance
  /// "vkCmdPipelineBarrier2". The name is a literal. Optional functions are left null when
  /// `debugUtils` is false: a loader may return trampolines for extensions that are not enabled.
  bool load(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance, VkDevice device,
            bool debugUtils, const char** missing);
};

}  // namespace alpenglow::engine
