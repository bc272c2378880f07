// Vulkan structs with their sType set.
#pragma once

#include <vulkan/vulkan_core.h>

namespace alpenglow::engine {

/// All zero but for its sType.
template <class Struct>
Struct structure(VkStructureType type) {
  Struct result = {};
  result.sType = type;
  return result;
}

}  // namespace alpenglow::engine
