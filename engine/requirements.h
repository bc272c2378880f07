// Comparing what the library needs with what a physical device offers or a host has enabled.
#pragma once

#include <alpenglow/types.h>

namespace alpenglow::engine {

/// Features that a device must offer, does offer, or was made with.
struct FeatureSet {
  uint32_t apiVersion = 0;  ///< Of the device, and of the instance's VkApplicationInfo.
  bool synchronization2 = false;
  bool dynamicRendering = false;
  VkPhysicalDeviceFeatures core = {};
};

/// Asks the physical device. Ok when it offers all of `needed`; else Unsupported, and `diagnostic`
/// (may be null) gets one sentence that names the device and lists every gap. A device or a Vulkan
/// loader of too low a version is named as the gap, and not the features that come with the
/// version. InvalidArgument for null handles. `offered` (may be null) is filled with what there is,
/// nothing where nothing could be asked. Thread-safe; the instance must be of Vulkan 1.1 or later.
Status checkPhysicalDevice(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance,
                           VkPhysicalDevice physicalDevice, const FeatureSet& needed,
                           DiagnosticFn diagnostic, void* user, FeatureSet* offered = nullptr);

/// Whether nothing of `needed` is missing.
bool offersAll(const FeatureSet& offered, const FeatureSet& needed);

/// Compares with what the host says it enabled, in the same way. `owner` is what the host calls the
/// description whose member `enabled` that is.
Status checkEnabled(const FeatureSet& needed, const FeatureSet& enabled, const char* owner,
                    DiagnosticFn diagnostic, void* user);

/// Adds what `more` needs to `needed`.
void mergeFeatures(const FeatureSet& more, FeatureSet* needed);

}  // namespace alpenglow::engine
