// A Vulkan device without a window, Alpenglow::headless: makes an instance and a device of its own,
// submits and waits. For samples, tests and command-line programs; a game engine has its own. A
// program with a window names the extensions that it needs and submits its frames itself.
// The Vulkan loader is opened at run time (dlopen), so nothing here links to it.
#pragma once

#include <alpenglow/context.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace alpenglow::headless {

/// Asks a physical device for what the program needs, as queryRequirements does.
using RequirementsFn = std::function<Status(PFN_vkGetInstanceProcAddr, VkInstance, VkPhysicalDevice,
                                            Requirements* out, std::string* missing)>;

struct DeviceOptions {
  std::string select;  ///< Empty: the first suitable; digits: the index; else part of its name.
  bool validation = false;      ///< VK_LAYER_KHRONOS_validation with synchronisation checks.
  RequirementsFn requirements;  ///< Null: Vulkan 1.3 with synchronization2 and dynamicRendering.
  /// Enabled as well; only a device that has all of them is chosen.
  std::vector<std::string> instanceExtensions, deviceExtensions;
  /// Whether to accept a queue family that has graphics and compute; null: any.
  std::function<bool(VkInstance, VkPhysicalDevice, uint32_t family)> queueFamily;
  /// Called with each validation message too, from whichever thread causes it, until the device's
  /// destructor has returned: so it hears of objects that outlive the device. May be null.
  std::function<void(std::string_view)> onValidationMessage;
};

/// User CPU seconds of the process over submit and wait (all threads, so software Vulkan's too),
/// and GPU seconds by timestamps, negative where the queue has none.
struct Timing {
  double cpuSeconds = 0.0;
  double gpuSeconds = -1.0;
};

class Device;

/// A buffer in host-visible, coherent memory, mapped for its whole life. Unmapped by its
/// destructor.
class HostBuffer {
 public:
  HostBuffer() = default;
  HostBuffer(HostBuffer&& other) noexcept;
  HostBuffer& operator=(HostBuffer&& other) noexcept;
  ~HostBuffer();
  VkBuffer buffer() const { return buffer_; }
  void* data() const { return data_; }
  VkDeviceSize size() const { return size_; }

 private:
  friend class Device;
  Device* device_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  void* data_ = nullptr;
  VkDeviceSize size_ = 0;
};

/// A 2D image with a view of all its levels, in device memory.
class Image {
 public:
  Image() = default;
  Image(Image&& other) noexcept;
  Image& operator=(Image&& other) noexcept;
  ~Image();
  VkImage image() const { return image_; }
  VkImageView view() const { return view_; }
  VkFormat format() const { return format_; }
  VkExtent2D extent() const { return extent_; }
  uint32_t levels() const { return levels_; }

 private:
  friend class Device;
  Device* device_ = nullptr;
  VkImage image_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  VkExtent2D extent_ = {};
  uint32_t levels_ = 0;
};

/// An instance, a device with one graphics-and-compute queue, and a command pool. Not thread-safe.
/// Functions that can fail return false (or an empty object) and put one sentence into `error`.
class Device {
 public:
  /// Null on failure: no loader, no driver, no suitable device; `error` says which gaps.
  static std::unique_ptr<Device> create(const DeviceOptions& options, std::string* error);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  PFN_vkGetInstanceProcAddr getInstanceProcAddr() const;
  VkInstance instance() const;
  VkPhysicalDevice physicalDevice() const;
  VkDevice device() const;
  VkQueue queue() const;
  uint32_t queueFamily() const;
  const Requirements& enabled() const;
  const std::string& name() const;
  bool debugUtils() const;  ///< VK_EXT_debug_utils is enabled (with validation).

  /// A description of a context on this device, ready for createContext; `diagnostics` is left
  /// null.
  ContextDesc contextDesc() const;

  /// Begins a command buffer, lets `record` fill it, submits and waits. False when `record` returns
  /// false (nothing is submitted, `error` is left to it) or Vulkan fails.
  bool run(const std::function<bool(VkCommandBuffer)>& record, std::string* error,
           Timing* timing = nullptr);
  /// Waits until the device is idle.
  void waitIdle() const;
  /// The frame that `run` records now, or would record next; the one below it has completed. For
  /// advanceFrame.
  uint64_t frame() const;
  /// Counts that frame as completed without commands, and returns the next one's number: after it,
  /// an advanceFrame frees what was destroyed before.
  uint64_t skipFrame();

  HostBuffer createHostBuffer(VkDeviceSize size, VkBufferUsageFlags usage, std::string* error);
  Image createImage(VkExtent2D extent, VkFormat format, VkImageUsageFlags usage, uint32_t levels,
                    std::string* error, VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT);
  /// Any device function, through vkGetDeviceProcAddr; null when unknown.
  PFN_vkVoidFunction function(const char* name) const;

  /// Warnings and errors that the validation layers have sent, oldest first. Empty without them.
  std::vector<std::string> validationMessages() const;
  void clearValidationMessages();

 private:
  friend class HostBuffer;
  friend class Image;
  struct Impl;
  Device();
  std::unique_ptr<Impl> impl_;
};

/// Names of the Vulkan devices, in index order. Empty with `error` set when there is no Vulkan.
std::vector<std::string> listDevices(std::string* error);

}  // namespace alpenglow::headless
