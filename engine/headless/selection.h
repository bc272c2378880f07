// Which physical device to use, and what to enable on it.
#pragma once

#include <alpenglow/headless.h>

#include "engine/headless/instance.h"

namespace alpenglow::headless {

struct Selection {
  VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
  uint32_t queueFamily = 0;
  uint32_t timestampBits = 0;  ///< Of the queue family; 0: it has no timestamps.
  Requirements enabled;        ///< What was asked for, with the features that we always enable.
};

/// False with one sentence in `error` when nothing fits; it lists what exists, or every gap.
bool selectDevice(Instance& instance, const DeviceOptions& options, Selection* out,
                  std::string* error);

}  // namespace alpenglow::headless
