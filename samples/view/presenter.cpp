#include "presenter.h"

#include <algorithm>

#include "common/failure.h"

namespace alpenglow::view {
namespace {

using samples::Gpu;

constexpr VkImageSubresourceRange kColor = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};

template <typename Function>
Function instanceFunction(const Gpu& gpu, const char* name) {
  const headless::Device& device = gpu.device();
  return reinterpret_cast<Function>(device.getInstanceProcAddr()(device.instance(), name));
}

template <typename Value, typename Function>
std::vector<Value> surfaceValues(const Gpu& gpu, VkSurfaceKHR surface, const char* name) {
  const auto get = instanceFunction<Function>(gpu, name);
  uint32_t count = 0;
  Gpu::check(get(gpu.device().physicalDevice(), surface, &count, nullptr), name);
  std::vector<Value> values(count);
  Gpu::check(get(gpu.device().physicalDevice(), surface, &count, values.data()), name);
  return values;
}

}  // namespace

Presenter::Presenter(const Gpu* gpu, const Window* window, bool vsync)
    : gpu_(gpu),
      window_(window),
      vsync_(vsync),
      vk_(*gpu),
      surface_(window->createSurface(gpu->device().instance())) {
  chooseFormat();
  makeRenderPass();
  makeSlots();
}

Presenter::~Presenter() {
  gpu_->device().waitIdle();
  images_.clear();
  swapchain_ = {};
  instanceFunction<PFN_vkDestroySurfaceKHR>(*gpu_, "vkDestroySurfaceKHR")(gpu_->device().instance(),
                                                                          surface_, nullptr);
}

// What tone.frag writes is sRGB already, with its dither, so that a screenshot has the same bytes.
void Presenter::chooseFormat() {
  const auto formats = surfaceValues<VkSurfaceFormatKHR, PFN_vkGetPhysicalDeviceSurfaceFormatsKHR>(
      *gpu_, surface_, "vkGetPhysicalDeviceSurfaceFormatsKHR");
  const auto found = std::find_if(formats.begin(), formats.end(), [](const auto& f) {
    return f.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR &&
           (f.format == VK_FORMAT_B8G8R8A8_UNORM || f.format == VK_FORMAT_R8G8B8A8_UNORM);
  });
  if (found == formats.end()) {
    throw samples::Failure("The window offers no 8-bit format without sRGB encoding of its own.");
  }
  format_ = *found;
}

void Presenter::makeSlots() {
  for (Slot& slot : slots_) {
    const VkCommandPoolCreateInfo pool = {VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0,
                                          gpu_->device().queueFamily()};
    slot.pool = make<VkCommandPool>(*gpu_, vk_.CreateCommandPool, pool, "vkDestroyCommandPool");
    const VkCommandBufferAllocateInfo commands = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                  nullptr, slot.pool.get(),
                                                  VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    Gpu::check(vk_.AllocateCommandBuffers(gpu_->device().device(), &commands, &slot.commands),
               "vkAllocateCommandBuffers");
    const VkFenceCreateInfo fence = {VK_STRUCTURE_TYPE_FENCE_CREATE_INFO, nullptr,
                                     VK_FENCE_CREATE_SIGNALED_BIT};
    slot.done = make<VkFence>(*gpu_, vk_.CreateFence, fence, "vkDestroyFence");
    const VkSemaphoreCreateInfo semaphore = {VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, nullptr, 0};
    slot.acquired = make<VkSemaphore>(*gpu_, vk_.CreateSemaphore, semaphore, "vkDestroySemaphore");
  }
}

void Presenter::makeRenderPass() {
  VkAttachmentDescription color = {};
  color.format = format_.format;
  color.samples = VK_SAMPLE_COUNT_1_BIT;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;  // The picture covers all of it.
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  color.stencilLoadOp = VK_ATTACHMENT_LOAD_OP_DONT_CARE;
  color.stencilStoreOp = VK_ATTACHMENT_STORE_OP_DONT_CARE;
  color.finalLayout = VK_IMAGE_LAYOUT_PRESENT_SRC_KHR;
  const VkAttachmentReference reference = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass = {};
  subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &reference;
  // The layout changes after the image was acquired, which this stage waits for.
  constexpr VkPipelineStageFlags kOutput = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  const VkSubpassDependency dependency = {
      VK_SUBPASS_EXTERNAL, 0, kOutput, kOutput, 0, VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT, 0};
  VkRenderPassCreateInfo info = {VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                 nullptr,
                                 0,
                                 1,
                                 &color,
                                 1,
                                 &subpass,
                                 1,
                                 &dependency};
  renderPass_ = make<VkRenderPass>(*gpu_, vk_.CreateRenderPass, info, "vkDestroyRenderPass");
}

// False while the window has no area.
bool Presenter::makeSwapchain() {
  VkSurfaceCapabilitiesKHR can = {};
  Gpu::check(instanceFunction<PFN_vkGetPhysicalDeviceSurfaceCapabilitiesKHR>(
                 *gpu_, "vkGetPhysicalDeviceSurfaceCapabilitiesKHR")(
                 gpu_->device().physicalDevice(), surface_, &can),
             "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  VkExtent2D size = can.currentExtent;
  if (size.width == UINT32_MAX) {
    size = window_->size();
    size.width = std::clamp(size.width, can.minImageExtent.width, can.maxImageExtent.width);
    size.height = std::clamp(size.height, can.minImageExtent.height, can.maxImageExtent.height);
  }
  if (size.width == 0 || size.height == 0) return false;
  const auto modes = surfaceValues<VkPresentModeKHR, PFN_vkGetPhysicalDeviceSurfacePresentModesKHR>(
      *gpu_, surface_, "vkGetPhysicalDeviceSurfacePresentModesKHR");
  VkPresentModeKHR mode = VK_PRESENT_MODE_FIFO_KHR;
  for (const VkPresentModeKHR fast : {VK_PRESENT_MODE_IMMEDIATE_KHR, VK_PRESENT_MODE_MAILBOX_KHR}) {
    if (!vsync_ && std::find(modes.begin(), modes.end(), fast) != modes.end()) mode = fast;
  }
  VkSwapchainCreateInfoKHR info = {};
  info.sType = VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR;
  info.surface = surface_;
  info.minImageCount = std::max(can.minImageCount, kFramesInFlight + 1);
  if (can.maxImageCount > 0) info.minImageCount = std::min(info.minImageCount, can.maxImageCount);
  info.imageFormat = format_.format;
  info.imageColorSpace = format_.colorSpace;
  info.imageExtent = size;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  info.preTransform = can.currentTransform;
  info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
  info.presentMode = mode;
  info.clipped = VK_TRUE;
  info.oldSwapchain = swapchain_.get();
  gpu_->device().waitIdle();  // Frames in flight still draw into the old one's images.
  auto made = make<VkSwapchainKHR>(*gpu_, vk_.CreateSwapchainKHR, info, "vkDestroySwapchainKHR");
  images_.clear();
  swapchain_ = std::move(made);
  size_ = size;

  uint32_t count = 0;
  const VkDevice device = gpu_->device().device();
  vk_.GetSwapchainImagesKHR(device, swapchain_.get(), &count, nullptr);
  std::vector<VkImage> handles(count);
  Gpu::check(vk_.GetSwapchainImagesKHR(device, swapchain_.get(), &count, handles.data()),
             "vkGetSwapchainImagesKHR");
  for (const VkImage handle : handles) {
    Image& image = images_.emplace_back();
    const VkImageViewCreateInfo view = {VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                        nullptr,
                                        0,
                                        handle,
                                        VK_IMAGE_VIEW_TYPE_2D,
                                        format_.format,
                                        {},
                                        kColor};
    image.view = make<VkImageView>(*gpu_, vk_.CreateImageView, view, "vkDestroyImageView");
    const VkImageView attachment = image.view.get();
    const VkFramebufferCreateInfo framebuffer = {VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                                 nullptr,
                                                 0,
                                                 renderPass_.get(),
                                                 1,
                                                 &attachment,
                                                 size.width,
                                                 size.height,
                                                 1};
    image.framebuffer =
        make<VkFramebuffer>(*gpu_, vk_.CreateFramebuffer, framebuffer, "vkDestroyFramebuffer");
    const VkSemaphoreCreateInfo semaphore = {VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO, nullptr, 0};
    image.drawn = make<VkSemaphore>(*gpu_, vk_.CreateSemaphore, semaphore, "vkDestroySemaphore");
  }
  outdated_ = false;
  return true;
}

bool Presenter::acquire(const Slot& slot) {
  const VkExtent2D window = window_->size();
  if (window.width == 0 || window.height == 0) return false;
  // Not every window system says that a swapchain has another size than its window.
  if (window.width != size_.width || window.height != size_.height) outdated_ = true;
  if (outdated_ && !makeSwapchain()) return false;
  const VkResult result =
      vk_.AcquireNextImageKHR(gpu_->device().device(), swapchain_.get(), UINT64_MAX,
                              slot.acquired.get(), VK_NULL_HANDLE, &image_);
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) outdated_ = true;
  if (result == VK_ERROR_OUT_OF_DATE_KHR) return false;
  Gpu::check(result, "vkAcquireNextImageKHR");
  return true;
}

bool Presenter::begin(Frame* frame) {
  frame->slot = static_cast<uint32_t>(numbers_.submitting % kFramesInFlight);
  Slot& slot = slots_[frame->slot];
  const VkDevice device = gpu_->device().device();
  const VkFence fence = slot.done.get();
  Gpu::check(vk_.WaitForFences(device, 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
  numbers_.completed = std::max(numbers_.completed, slot.frame);
  if (!acquire(slot)) return false;
  frame->size = size_;
  frame->commands = slot.commands;
  Gpu::check(vk_.ResetCommandPool(device, slot.pool.get(), 0), "vkResetCommandPool");
  const VkCommandBufferBeginInfo begin = {VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr,
                                          VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT, nullptr};
  Gpu::check(vk_.BeginCommandBuffer(slot.commands, &begin), "vkBeginCommandBuffer");
  return true;
}

void Presenter::beginPass(const Frame& frame) const {
  VkRenderPassBeginInfo begin = {};
  begin.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
  begin.renderPass = renderPass_.get();
  begin.framebuffer = images_[image_].framebuffer.get();
  begin.renderArea = {{0, 0}, size_};
  vk_.CmdBeginRenderPass(frame.commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
}

void Presenter::show(const Frame& frame) {
  vk_.CmdEndRenderPass(frame.commands);
  Gpu::check(vk_.EndCommandBuffer(frame.commands), "vkEndCommandBuffer");
  Slot& slot = slots_[frame.slot];
  const VkFence fence = slot.done.get();
  Gpu::check(vk_.ResetFences(gpu_->device().device(), 1, &fence), "vkResetFences");
  const VkSemaphore acquired = slot.acquired.get(), drawn = images_[image_].drawn.get();
  const VkPipelineStageFlags waits = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT;
  const VkSubmitInfo submit = {
      VK_STRUCTURE_TYPE_SUBMIT_INFO, nullptr, 1, &acquired, &waits, 1, &frame.commands, 1, &drawn};
  Gpu::check(vk_.QueueSubmit(gpu_->device().queue(), 1, &submit, fence), "vkQueueSubmit");
  slot.frame = numbers_.submitting++;
  const VkSwapchainKHR swapchain = swapchain_.get();
  const VkPresentInfoKHR present = {
      VK_STRUCTURE_TYPE_PRESENT_INFO_KHR, nullptr, 1, &drawn, 1, &swapchain, &image_, nullptr};
  const VkResult result = vk_.QueuePresentKHR(gpu_->device().queue(), &present);
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) {
    outdated_ = true;
  } else {
    Gpu::check(result, "vkQueuePresentKHR");
  }
}

}  // namespace alpenglow::view
