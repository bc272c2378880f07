// The Vulkan functions that the viewer calls itself, from its own device.
#pragma once

#include "common/gpu.h"

namespace alpenglow::view {

// clang-format off
#define ALPENGLOW_VIEW_FUNCTIONS(X) \
  X(AcquireNextImageKHR) X(AllocateCommandBuffers) X(AllocateDescriptorSets) X(BeginCommandBuffer) \
  X(CmdBeginRenderPass) X(CmdBindDescriptorSets) X(CmdBindPipeline) X(CmdBlitImage) \
  X(CmdCopyImageToBuffer) X(CmdDraw) X(CmdEndRenderPass) X(CmdPushConstants) X(CmdResetQueryPool) \
  X(CmdSetScissor) X(CmdSetViewport) X(CmdWriteTimestamp2) X(CreateCommandPool) \
  X(CreateDescriptorPool) X(CreateFence) X(CreateFramebuffer) X(CreateImageView) X(CreateQueryPool) \
  X(CreateRenderPass) X(CreateSemaphore) X(CreateSwapchainKHR) \
  X(EndCommandBuffer) X(GetQueryPoolResults) X(GetSwapchainImagesKHR) X(QueuePresentKHR) \
  X(QueueSubmit) X(ResetCommandPool) X(ResetFences) X(UpdateDescriptorSets) X(WaitForFences)
// clang-format on

struct Functions {
#define ALPENGLOW_VIEW_MEMBER(name) PFN_vk##name name;
  ALPENGLOW_VIEW_FUNCTIONS(ALPENGLOW_VIEW_MEMBER)
#undef ALPENGLOW_VIEW_MEMBER

  explicit Functions(const samples::Gpu& gpu)
#define ALPENGLOW_VIEW_LOAD(name) name(gpu.function<PFN_vk##name>("vk" #name)),
      : ALPENGLOW_VIEW_FUNCTIONS(ALPENGLOW_VIEW_LOAD) end(0) {
  }
#undef ALPENGLOW_VIEW_LOAD
  int end;
};

/// vkCreate...(device, &info, nullptr, &handle), checked and owned.
template <typename Handle, typename Create, typename Info>
samples::Owned<Handle> make(const samples::Gpu& gpu, Create create, const Info& info,
                            const char* destroy) {
  Handle handle = VK_NULL_HANDLE;
  samples::Gpu::check(create(gpu.device().device(), &info, nullptr, &handle), destroy);
  return {gpu.device(), destroy, handle};
}

}  // namespace alpenglow::view
