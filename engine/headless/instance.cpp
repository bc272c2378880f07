#include "engine/headless/instance.h"

#include <cstring>

#include "engine/headless/platform.h"
#include "engine/result.h"
#include "engine/structure.h"

namespace alpenglow::headless {
namespace {

using engine::structure;

constexpr char kLayer[] = "VK_LAYER_KHRONOS_validation";
constexpr char kNoDevice[] =
    "No Vulkan device was found: install a driver such as the package mesa-vulkan-drivers, and "
    "check that VK_DRIVER_FILES, if it is set, names a driver's file.";

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                         VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data,
                                         void* user) {
  static_cast<MessageLog*>(user)->add(data->pMessage != nullptr ? data->pMessage : "");
  return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messengerInfo(MessageLog* log) {
  auto info = structure<VkDebugUtilsMessengerCreateInfoEXT>(
      VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  info.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  // Not general ones: those are the driver's own, such as Mesa's doubts about `invariant
  // gl_Position`.
  info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                     VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  info.pfnUserCallback = onMessage;
  info.pUserData = log;
  return info;
}

}  // namespace

bool setError(std::string* error, std::string sentence) {
  if (error != nullptr) *error = std::move(sentence);
  return false;
}

std::string resultSentence(const char* call, VkResult result) {
  return std::string(call) + " returned " + engine::resultName(result) + " (" +
         std::to_string(static_cast<int>(result)) + ").";
}

void MessageLog::add(const char* message) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.emplace_back(message);
  }
  if (listener_) listener_(message);
}

std::vector<std::string> MessageLog::messages() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return messages_;
}

void MessageLog::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  messages_.clear();
}

std::unique_ptr<Instance> Instance::create(const DeviceOptions& options, std::string* error) {
  std::unique_ptr<Instance> instance(new Instance(options));
  if (!instance->openLoader(error)) return nullptr;
  if (options.validation && !instance->checkValidationLayer(error)) return nullptr;
  if (!instance->createInstance(error)) return nullptr;
  return instance;
}

Instance::~Instance() {
  if (messenger_ != VK_NULL_HANDLE) {
    vk_.DestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
  }
  if (instance_ != VK_NULL_HANDLE) vk_.DestroyInstance(instance_, nullptr);
  if (library_ != nullptr) closeLibrary(library_);
}

bool Instance::openLoader(std::string* error) {
  std::string reason;
  library_ = openLibrary(kLoader, &reason);
  if (library_ == nullptr) {
    return setError(error, std::string("The Vulkan loader ") + kLoader +
                               " can't be opened: install " + kLoaderComesWith + " (" + reason +
                               ").");
  }
  getInstanceProcAddr_ =
      reinterpret_cast<PFN_vkGetInstanceProcAddr>(findFunction(library_, "vkGetInstanceProcAddr"));
  if (getInstanceProcAddr_ == nullptr) {
    return setError(error, std::string("The library ") + kLoader +
                               " has no vkGetInstanceProcAddr, so it is not a Vulkan loader.");
  }
  if (const char* missing = vk_.loadGlobal(getInstanceProcAddr_)) {
    return setError(error, std::string("The Vulkan loader has no function ") + missing +
                               ", but one of Vulkan 1.1 or later is needed.");
  }
  return true;
}

bool Instance::checkValidationLayer(std::string* error) {
  uint32_t count = 0;
  vk_.EnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vk_.EnumerateInstanceLayerProperties(&count, layers.data());
  layers.resize(count);
  for (const VkLayerProperties& layer : layers) {
    if (std::strcmp(layer.layerName, kLayer) == 0) return true;
  }
  return setError(error, std::string("Validation was asked for, but the layer ") + kLayer +
                             " is not installed: install the package vulkan-validationlayers.");
}

bool Instance::createInstance(std::string* error) {
  auto application = structure<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "alpenglow";
  application.apiVersion = VK_API_VERSION_1_3;
  const auto messenger = messengerInfo(&log_);
  const VkValidationFeatureEnableEXT enabled[] = {
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  auto features = structure<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
  features.pNext = &messenger;  // For messages while the instance is made and destroyed.
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = enabled;
  const char* layers[] = {kLayer};
  std::vector<const char*> extensions;
  for (const std::string& extension : extensions_) extensions.push_back(extension.c_str());
  auto info = structure<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pApplicationInfo = &application;
  if (validation_) {
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = layers;
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  }
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  const VkResult result = vk_.CreateInstance(&info, nullptr, &instance_);
  if (result < 0) {
    instance_ = VK_NULL_HANDLE;
    // What the loader answers when it finds no driver at all.
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) return setError(error, kNoDevice);
    return setError(error, resultSentence("vkCreateInstance", result));
  }
  keepDrivers();
  if (const char* missing = vk_.loadInstance(getInstanceProcAddr_, instance_, validation_)) {
    return setError(error, std::string("The Vulkan instance has no function ") + missing + ".");
  }
  if (!validation_) return true;
  const VkResult made =
      vk_.CreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_);
  if (made < 0) {
    return setError(error, resultSentence("vkCreateDebugUtilsMessengerEXT", made));
  }
  return true;
}

std::vector<VkPhysicalDevice> Instance::physicalDevices(std::string* error) {
  uint32_t count = 0;
  VkResult result = vk_.EnumeratePhysicalDevices(instance_, &count, nullptr);
  std::vector<VkPhysicalDevice> devices(count);
  if (result >= 0 && count > 0) {
    result = vk_.EnumeratePhysicalDevices(instance_, &count, devices.data());
    devices.resize(count);
  }
  if (result < 0) {
    setError(error, resultSentence("vkEnumeratePhysicalDevices", result));
    return {};
  }
  if (devices.empty()) setError(error, kNoDevice);
  return devices;
}

std::string Instance::nameOf(VkPhysicalDevice physicalDevice) const {
  VkPhysicalDeviceProperties properties = {};
  vk_.GetPhysicalDeviceProperties(physicalDevice, &properties);
  return properties.deviceName;
}

}  // namespace alpenglow::headless
