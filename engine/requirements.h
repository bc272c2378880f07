// Comparing what the library needs with what a physical device offers or a host has enabled.
#pragma once

#include <alpenglow/context.h>

namespace alpenglow::engine {

/// Asks the physical device. Ok when it offers all of `needed`; else Unsupported, and `diagnostic`
/// (may be null) gets one sentence that names the device and lists every gap. InvalidArgument for
/// null handles. Thread-safe; the instance must be of Vulkan 1.1 or later.
Status checkPhysicalDevice(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance,
                           VkPhysicalDevice physicalDevice, const Requirements& needed,
                           DiagnosticFn diagnostic, void* user);

/// Compares with what the host says it enabled (ContextDesc::enabled), in the same way.
Status checkEnabled(const Requirements& needed, const Requirements& enabled,
                    DiagnosticFn diagnostic, void* user);

/// Adds what `more` needs to `needed`.
void mergeRequirements(const Requirements& more, Requirements* needed);

}  // namespace alpenglow::engine
