// The few Vulkan objects that a host's scene takes, owned. A game engine has its own of all this.
#pragma once

#include <alpenglow/headless.h>
#include <alpenglow/headless_states.h>
#include <alpenglow/io/image_file.h>

#include <cstddef>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

namespace alpenglow::samples {

// States of images, for barriers.
using headless::ImageState;
using headless::kColorDrawn;
using headless::kCopySource;
using headless::kCopyTarget;
using headless::kDepthDrawn;
using headless::kDepthRead;
using headless::kSampled;
using headless::kUndefined;

/// One sentence for people.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A handle that one vkDestroy... or vkFree... of (device, handle, allocator) takes back.
template <typename Handle>
class Owned {
 public:
  Owned() = default;
  Owned(const headless::Device& device, const char* destroy, Handle handle)
      : destroy_(reinterpret_cast<Destroy>(device.function(destroy))),
        device_(device.device()),
        handle_(handle) {}
  Owned(Owned&& other) noexcept { *this = std::move(other); }
  Owned& operator=(Owned&& other) noexcept {
    std::swap(destroy_, other.destroy_);
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Owned() {
    if (handle_ != VK_NULL_HANDLE) destroy_(device_, handle_, nullptr);
  }
  Handle get() const { return handle_; }

 private:
  using Destroy = void(VKAPI_PTR*)(VkDevice, Handle, const VkAllocationCallbacks*);
  Destroy destroy_ = nullptr;
  VkDevice device_ = VK_NULL_HANDLE;
  Handle handle_ = VK_NULL_HANDLE;
};

/// SPIR-V as shaders are embedded.
using Code = std::span<const uint32_t>;

enum class Blending {
  None,
  Alpha,  ///< Blended over the picture.
  Add,    ///< Light is added to the picture.
};

/// A pipeline with viewport and scissor set while recording.
struct PipelineDesc {
  Code vertex;
  Code fragment;  ///< Empty: depth only.
  VkPipelineLayout layout = VK_NULL_HANDLE;
  uint32_t vertexStride = 0;  ///< 0: no vertex buffer.
  std::span<const VkVertexInputAttributeDescription> attributes;
  VkFormat color = VK_FORMAT_UNDEFINED;
  VkFormat depth = VK_FORMAT_UNDEFINED;
  VkRenderPass renderPass = VK_NULL_HANDLE;  ///< Null: dynamic rendering.
  bool writesDepth = false;  ///< Nearest wins; else drawn where not farther than what is there.
  Blending blending = Blending::None;
  const VkSpecializationInfo* fragmentConstants = nullptr;
};

/// Makes things on a device and records commands. Functions throw an Error.
class Gpu {
 public:
  /// Records, submits and waits; the name is for reports.
  using RunFn =
      std::function<void(const char* pass, const std::function<void(VkCommandBuffer)>& record)>;

  /// Throws unless the status is Ok, with the sentence that the library gave its context.
  using CheckFn = std::function<void(Status)>;

  /// All outlive it.
  Gpu(headless::Device* device, RunFn run, CheckFn check)
      : device_(device), run_(std::move(run)), check_(std::move(check)) {}

  headless::Device& device() const { return *device_; }

  /// A device function by the type of its pointer: function<PFN_vkCmdDraw>("vkCmdDraw").
  template <typename Function>
  Function function(const char* name) const {
    return reinterpret_cast<Function>(require(name));
  }

  headless::Image image(VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
                        uint32_t levels) const;
  /// Filled with `data`, or left as it is without.
  headless::HostBuffer buffer(VkDeviceSize bytes, VkBufferUsageFlags usage,
                              const void* data = nullptr) const;
  /// An sRGB texture, ready for fragment shaders, in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL.
  headless::Image texture(const io::AlbedoMap& map) const;
  /// The same of one texel of 32-bit floats.
  headless::Image texel(const float rgba[4]) const;
  /// Records what `record` records in a rendering scope over `area` of the target, which is cleared
  /// first or kept; `depth` may be null.
  void render(VkCommandBuffer commands, const headless::Image& target, const VkRect2D& area,
              VkAttachmentLoadOp load, const VkRenderingAttachmentInfo* depth,
              const std::function<void()>& record) const;
  /// Linear, with mip levels, clamped in v.
  Owned<VkSampler> sampler(VkSamplerAddressMode modeU) const;

  Owned<VkDescriptorSetLayout> setLayout(
      std::span<const VkDescriptorSetLayoutBinding> bindings) const;
  Owned<VkPipelineLayout> pipelineLayout(std::span<const VkDescriptorSetLayout> sets,
                                         const VkPushConstantRange& push) const;
  Owned<VkPipeline> pipeline(const PipelineDesc& desc) const;

  /// Moves all levels of an image from one use to the next.
  void barrier(VkCommandBuffer commands, const headless::Image& image, const ImageState& from,
               const ImageState& to) const;
  /// Orders memory accesses of two uses; layouts don't count.
  void barrier(VkCommandBuffer commands, const ImageState& from, const ImageState& to) const;

  /// Records, submits and waits.
  void run(const char* pass, const std::function<void(VkCommandBuffer)>& record) const {
    run_(pass, record);
  }

  /// Throws unless the status is Ok.
  void check(Status status) const { check_(status); }
  /// Throws unless the result is good; `what` is a function's name.
  static void check(VkResult result, const char* what);

 private:
  PFN_vkVoidFunction require(const char* name) const;
  Owned<VkShaderModule> shaderModule(Code code) const;
  headless::Image upload(VkExtent2D extent, VkFormat format,
                         std::span<const std::span<const std::byte>> levels) const;

  headless::Device* device_;
  RunFn run_;
  CheckFn check_;
};

}  // namespace alpenglow::samples
