// Vulkan results as names and as statuses.
#pragma once

#include <alpenglow/types.h>

namespace alpenglow::engine {

/// "VK_ERROR_OUT_OF_DEVICE_MEMORY"; "VkResult" for a value that we don't know. A literal.
const char* resultName(VkResult result);
/// The status that stands for a result: Ok for all non-negative ones.
Status statusOf(VkResult result);

}  // namespace alpenglow::engine
