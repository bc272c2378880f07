#include "engine/headless/selection.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "engine/requirements.h"
#include "engine/structure.h"

namespace alpenglow::headless {
namespace {

using engine::structure;

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool isNumber(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(),
                                      [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// `0 "llvmpipe (LLVM 15.0.6, 256 bits)", 1 "..."`
std::string listNames(const Instance& instance, const std::vector<VkPhysicalDevice>& devices) {
  std::string list;
  for (size_t i = 0; i < devices.size(); ++i) {
    list += (i == 0 ? "" : ", ") + std::to_string(i) + " \"" + instance.nameOf(devices[i]) + "\"";
  }
  return list;
}

/// Keeps in `devices` only those that `select` names.
bool narrow(const Instance& instance, const std::string& select,
            std::vector<VkPhysicalDevice>* devices, std::string* error) {
  std::vector<VkPhysicalDevice> chosen;
  if (isNumber(select)) {
    size_t index = devices->size();
    std::from_chars(select.data(), select.data() + select.size(), index);
    if (index < devices->size()) chosen = {(*devices)[index]};
  } else {
    std::copy_if(
        devices->begin(), devices->end(), std::back_inserter(chosen), [&](VkPhysicalDevice device) {
          return lowerCase(instance.nameOf(device)).find(lowerCase(select)) != std::string::npos;
        });
  }
  if (chosen.empty()) {
    return setError(error, std::string("No Vulkan device has the ") +
                               (isNumber(select) ? "index " : "name ") + "\"" + select +
                               "\"; these exist: " + listNames(instance, *devices) + ".");
  }
  *devices = std::move(chosen);
  return true;
}

Status defaultRequirements(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance,
                           VkPhysicalDevice physicalDevice, Requirements* out,
                           std::string* missing) {
  engine::FeatureSet needed;
  out->apiVersion = needed.apiVersion = VK_API_VERSION_1_3;
  needed.synchronization2 = needed.dynamicRendering = true;
  out->deviceFeatures = kFeatureSynchronization2 | kFeatureDynamicRendering;
  out->features = needed.core;
  return engine::checkPhysicalDevice(
      getInstanceProcAddr, instance, physicalDevice, needed,
      [](void* user, const Diagnostic& diagnostic) {
        *static_cast<std::string*>(user) = diagnostic.message;
      },
      missing);
}

bool findQueueFamily(Instance& instance, const DeviceOptions& options, Selection* selection) {
  const auto getFamilies = instance.vk().GetPhysicalDeviceQueueFamilyProperties;
  uint32_t count = 0;
  getFamilies(selection->physicalDevice, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  getFamilies(selection->physicalDevice, &count, families.data());
  constexpr VkQueueFlags kNeeded = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  for (uint32_t i = 0; i < count; ++i) {
    if ((families[i].queueFlags & kNeeded) == kNeeded && families[i].queueCount > 0 &&
        (!options.queueFamily ||
         options.queueFamily(instance.handle(), selection->physicalDevice, i))) {
      selection->queueFamily = i;
      selection->timestampBits = families[i].timestampValidBits;
      return true;
    }
  }
  return false;
}

/// Empty when the device has all extensions, else the first that it lacks.
std::string missingExtension(Instance& instance, VkPhysicalDevice physicalDevice,
                             const std::vector<std::string>& wanted) {
  const auto getExtensions = instance.vk().EnumerateDeviceExtensionProperties;
  uint32_t count = 0;
  getExtensions(physicalDevice, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  getExtensions(physicalDevice, nullptr, &count, extensions.data());
  for (const std::string& name : wanted) {
    if (std::none_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& e) {
          return name == static_cast<const char*>(e.extensionName);
        })) {
      return name;
    }
  }
  return "";
}

/// Both are enabled wherever the device has them: the library's users may need them without asking.
void addUsualFeatures(Instance& instance, VkPhysicalDevice physicalDevice, Requirements* enabled) {
  VkPhysicalDeviceProperties properties = {};
  instance.vk().GetPhysicalDeviceProperties(physicalDevice, &properties);
  enabled->apiVersion = std::min(properties.apiVersion, VK_API_VERSION_1_3);
  if (properties.apiVersion < VK_API_VERSION_1_3) return;
  auto features13 = structure<VkPhysicalDeviceVulkan13Features>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
  auto features =
      structure<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  features.pNext = &features13;
  instance.vk().GetPhysicalDeviceFeatures2(physicalDevice, &features);
  if (features13.synchronization2 != VK_FALSE) enabled->deviceFeatures |= kFeatureSynchronization2;
  if (features13.dynamicRendering != VK_FALSE) enabled->deviceFeatures |= kFeatureDynamicRendering;
}

bool suits(Instance& instance, const DeviceOptions& options, const RequirementsFn& ask,
           Selection* selection, std::string* missing) {
  const std::string name = instance.nameOf(selection->physicalDevice);
  if (!findQueueFamily(instance, options, selection)) {
    *missing = "The device \"" + name + "\" has no queue for both graphics and compute" +
               (options.queueFamily ? " that will do for the program's window." : ".");
    return false;
  }
  const std::string lacked =
      missingExtension(instance, selection->physicalDevice, options.deviceExtensions);
  if (!lacked.empty()) {
    *missing = "The device \"" + name + "\" lacks the extension " + lacked + ".";
    return false;
  }
  const Status status = ask(instance.getInstanceProcAddr(), instance.handle(),
                            selection->physicalDevice, &selection->enabled, missing);
  if (status != Status::Ok) {
    if (missing->empty()) *missing = "The device \"" + name + "\" doesn't offer what is needed.";
    return false;
  }
  addUsualFeatures(instance, selection->physicalDevice, &selection->enabled);
  return true;
}

}  // namespace

bool selectDevice(Instance& instance, const DeviceOptions& options, Selection* out,
                  std::string* error) {
  std::vector<VkPhysicalDevice> devices = instance.physicalDevices(error);
  if (devices.empty()) return false;
  if (!options.select.empty() && !narrow(instance, options.select, &devices, error)) return false;

  const RequirementsFn ask = options.requirements ? options.requirements : defaultRequirements;
  std::string gaps;
  for (VkPhysicalDevice device : devices) {
    Selection selection;
    selection.physicalDevice = device;
    std::string missing;
    if (suits(instance, options, ask, &selection, &missing)) {
      *out = selection;
      return true;
    }
    gaps += (gaps.empty() ? "" : " ") + missing;
  }
  return setError(error, gaps);
}

}  // namespace alpenglow::headless
