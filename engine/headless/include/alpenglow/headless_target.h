// A render target for programs without a window, with readback to the CPU. Part of
// Alpenglow::headless.
#pragma once

#include <alpenglow/headless.h>
#include <alpenglow/headless_states.h>

#include <memory>
#include <string>
#include <vector>

namespace alpenglow::headless {

struct TargetDesc {
  VkExtent2D extent = {};
  VkFormat color = VK_FORMAT_R32G32B32A32_SFLOAT;  ///< Or R16G16B16A16_SFLOAT.
  VkFormat depth = VK_FORMAT_UNDEFINED;
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;  ///< Resolved by averaging.
  bool renderPass = false;                                ///< Else dynamic rendering.
};

struct TargetClear {
  float color = 0.0f;  ///< Of each channel.
  float depth = 1.0f;
};

/// A colour image, with or without depth. Record prepare(), then scopes, then copy(); and read
/// pixels() when that has been submitted. Not thread-safe; destroyed before its device.
class Target {
 public:
  /// Null on failure, with a sentence.
  static std::unique_ptr<Target> create(Device& device, const TargetDesc& desc, std::string* error);
  ~Target();
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  VkRenderPass renderPass() const { return renderPass_; }  ///< Null with dynamic rendering.
  VkExtent2D extent() const { return desc_.extent; }

  /// Makes the images ready for drawing, whatever their state; their contents are lost.
  void prepare(VkCommandBuffer commands);
  /// A rendering scope over `area`. With a render pass each clears, and its area is the extent.
  void begin(VkCommandBuffer commands, const VkRect2D& area, VkAttachmentLoadOp load,
             const TargetClear& clear = {});
  void end(VkCommandBuffer commands);
  /// Copies the `size` pixels of the upper left corner, for pixels().
  void copy(VkCommandBuffer commands, VkExtent2D size);
  /// Linear RGBA of the last copy, which had this size; row 0 at the top.
  std::vector<float> pixels(VkExtent2D size) const;

 private:
  Target(Device& device, const TargetDesc& desc) : device_(device), desc_(desc) {}
  bool make(std::string* error);
  bool makeRenderPass(std::string* error);
  void beginRenderPass(VkCommandBuffer commands, const VkRect2D& area, const TargetClear& clear);
  void barrier(VkCommandBuffer commands, const Image& image, VkImageAspectFlags aspect,
               const ImageState& before, const ImageState& after);
  bool multisampled() const { return desc_.samples != VK_SAMPLE_COUNT_1_BIT; }
  template <class Function>
  Function function(const char* name) const {
    return reinterpret_cast<Function>(device_.function(name));
  }

  Device& device_;
  TargetDesc desc_;
  Image color_, resolved_, depth_;
  VkRenderPass renderPass_ = VK_NULL_HANDLE;
  VkFramebuffer framebuffer_ = VK_NULL_HANDLE;
  HostBuffer readback_;
};

}  // namespace alpenglow::headless
