// A swapchain with two frames in flight.
#pragma once

#include <vector>

#include "vulkan.h"
#include "window.h"

namespace alpenglow::view {

inline constexpr uint32_t kFramesInFlight = 2;

/// One frame while it is recorded.
struct Frame {
  VkCommandBuffer commands = VK_NULL_HANDLE;
  uint32_t slot = 0;  ///< 0 ... kFramesInFlight - 1: what the frame before last used is free again.
  VkExtent2D size = {};
};

/// Of the frame being recorded, and of the newest that has completed.
struct FrameNumbers {
  uint64_t submitting = 1, completed = 0;
};

class Presenter {
 public:
  /// All outlive it. Throws.
  Presenter(const samples::Gpu* gpu, const Window* window, bool vsync);
  Presenter(const Presenter&) = delete;
  Presenter& operator=(const Presenter&) = delete;
  ~Presenter();

  /// Numbers for the library: of the frame being recorded, or to be recorded next.
  FrameNumbers numbers() const { return numbers_; }
  /// Waits until the frame before last is through, and begins a command buffer. False where there
  /// is nothing to draw into: minimised, or being resized.
  bool begin(Frame* frame);
  /// The pass into the window's image, around what `record` draws; ends the frame and shows it.
  template <typename Record>
  void end(const Frame& frame, const Record& record) {
    beginPass(frame);
    record();
    show(frame);
  }

  /// One colour attachment, which is not cleared; ends ready to be shown.
  VkRenderPass renderPass() const { return renderPass_.get(); }
  uint32_t imageCount() const { return static_cast<uint32_t>(images_.size()); }

 private:
  struct Slot {
    samples::Owned<VkCommandPool> pool;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    samples::Owned<VkFence> done;
    samples::Owned<VkSemaphore> acquired;
    uint64_t frame = 0;  ///< That it ran last.
  };
  struct Image {
    samples::Owned<VkImageView> view;
    samples::Owned<VkFramebuffer> framebuffer;
    samples::Owned<VkSemaphore> drawn;
  };
  void chooseFormat();
  void makeSlots();
  void makeRenderPass();
  bool makeSwapchain();
  bool acquire(const Slot& slot);
  void beginPass(const Frame& frame) const;
  void show(const Frame& frame);

  const samples::Gpu* gpu_;
  const Window* window_;
  bool vsync_;
  Functions vk_;
  VkSurfaceKHR surface_ = VK_NULL_HANDLE;
  VkSurfaceFormatKHR format_ = {};
  samples::Owned<VkRenderPass> renderPass_;
  samples::Owned<VkSwapchainKHR> swapchain_;
  VkExtent2D size_ = {};
  bool outdated_ = true;
  std::vector<Image> images_;
  uint32_t image_ = 0;
  Slot slots_[kFramesInFlight];
  FrameNumbers numbers_;
};

}  // namespace alpenglow::view
