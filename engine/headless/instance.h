// The loader, a VkInstance on it, and the messages of the validation layers.
#pragma once

#include <alpenglow/headless.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "engine/headless/functions.h"

namespace alpenglow::headless {

/// Warnings and errors of the layers, which may come from any thread.
class MessageLog {
 public:
  explicit MessageLog(std::function<void(std::string_view)> listener)
      : listener_(std::move(listener)) {}
  void add(const char* message);
  std::vector<std::string> messages() const;
  void clear();

 private:
  std::function<void(std::string_view)> listener_;
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
};

/// Owns all three; the destructor undoes what was made.
class Instance {
 public:
  /// Null on failure, with one sentence in `error`.
  static std::unique_ptr<Instance> create(const DeviceOptions& options, std::string* error);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  PFN_vkGetInstanceProcAddr getInstanceProcAddr() const { return getInstanceProcAddr_; }
  VkInstance handle() const { return instance_; }
  bool validation() const { return validation_; }
  Functions& vk() { return vk_; }
  MessageLog& log() { return log_; }

  /// At least one; empty on failure, with one sentence in `error`.
  std::vector<VkPhysicalDevice> physicalDevices(std::string* error);
  std::string nameOf(VkPhysicalDevice physicalDevice) const;

 private:
  explicit Instance(const DeviceOptions& options)
      : validation_(options.validation),
        extensions_(options.instanceExtensions),
        log_(options.onValidationMessage) {}
  bool openLoader(std::string* error);
  bool checkValidationLayer(std::string* error);
  bool createInstance(std::string* error);

  bool validation_;
  std::vector<std::string> extensions_;
  MessageLog log_;
  void* library_ = nullptr;
  PFN_vkGetInstanceProcAddr getInstanceProcAddr_ = nullptr;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  Functions vk_;
};

/// Stores the sentence if `error` is given; returns false, for `return setError(...)`.
bool setError(std::string* error, std::string sentence);
/// "vkCreateInstance returned VK_ERROR_... (-3)."
std::string resultSentence(const char* call, VkResult result);

}  // namespace alpenglow::headless
