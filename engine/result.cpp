#include "engine/result.h"

namespace alpenglow::engine {

const char* resultName(VkResult result) {
  switch (result) {
#define ALPENGLOW_CASE(name) \
  case name:                 \
    return #name;
    ALPENGLOW_CASE(VK_SUCCESS)
    ALPENGLOW_CASE(VK_NOT_READY)
    ALPENGLOW_CASE(VK_TIMEOUT)
    ALPENGLOW_CASE(VK_INCOMPLETE)
    ALPENGLOW_CASE(VK_ERROR_OUT_OF_HOST_MEMORY)
    ALPENGLOW_CASE(VK_ERROR_OUT_OF_DEVICE_MEMORY)
    ALPENGLOW_CASE(VK_ERROR_INITIALIZATION_FAILED)
    ALPENGLOW_CASE(VK_ERROR_DEVICE_LOST)
    ALPENGLOW_CASE(VK_ERROR_MEMORY_MAP_FAILED)
    ALPENGLOW_CASE(VK_ERROR_LAYER_NOT_PRESENT)
    ALPENGLOW_CASE(VK_ERROR_EXTENSION_NOT_PRESENT)
    ALPENGLOW_CASE(VK_ERROR_FEATURE_NOT_PRESENT)
    ALPENGLOW_CASE(VK_ERROR_INCOMPATIBLE_DRIVER)
    ALPENGLOW_CASE(VK_ERROR_TOO_MANY_OBJECTS)
    ALPENGLOW_CASE(VK_ERROR_FORMAT_NOT_SUPPORTED)
    ALPENGLOW_CASE(VK_ERROR_FRAGMENTED_POOL)
    ALPENGLOW_CASE(VK_ERROR_UNKNOWN)
    ALPENGLOW_CASE(VK_ERROR_OUT_OF_POOL_MEMORY)
    ALPENGLOW_CASE(VK_ERROR_INVALID_EXTERNAL_HANDLE)
    ALPENGLOW_CASE(VK_ERROR_FRAGMENTATION)
    ALPENGLOW_CASE(VK_ERROR_INVALID_OPAQUE_CAPTURE_ADDRESS)
    ALPENGLOW_CASE(VK_PIPELINE_COMPILE_REQUIRED)
    ALPENGLOW_CASE(VK_ERROR_INVALID_SHADER_NV)
#undef ALPENGLOW_CASE
    default:
      return "VkResult";
  }
}

Status statusOf(VkResult result) {
  if (result >= 0) return Status::Ok;
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return Status::OutOfHostMemory;
    // To a host, running out of pool space or of allocations equals running out of device memory:
    // the remedy is the same.
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_FRAGMENTED_POOL:
    case VK_ERROR_TOO_MANY_OBJECTS:
      return Status::OutOfDeviceMemory;
    case VK_ERROR_DEVICE_LOST:
      return Status::DeviceLost;
    default:
      return Status::VulkanError;
  }
}

}  // namespace alpenglow::engine
