#include "engine/dispatch.h"

namespace alpenglow::engine {

bool Dispatch::load(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance,
                    VkDevice device, bool debugUtils, const char** missing) {
  const auto reject = [missing](const char* name) {
    if (missing != nullptr) *missing = name;
    return false;
  };
#define ALPENGLOW_LOAD(name)                                                        \
  name = reinterpret_cast<PFN_vk##name>(getInstanceProcAddr(instance, "vk" #name)); \
  if (name == nullptr) return reject("vk" #name);
  ALPENGLOW_INSTANCE_FUNCTIONS(ALPENGLOW_LOAD)
#undef ALPENGLOW_LOAD
  if (device == VK_NULL_HANDLE) return true;

#define ALPENGLOW_LOAD(name)                                                    \
  name = reinterpret_cast<PFN_vk##name>(GetDeviceProcAddr(device, "vk" #name)); \
  if (name == nullptr) return reject("vk" #name);
  ALPENGLOW_DEVICE_FUNCTIONS(ALPENGLOW_LOAD)
#undef ALPENGLOW_LOAD

  // An instance extension: its commands come through the instance even where they take a device.
#define ALPENGLOW_LOAD(name)                                                                    \
  name = debugUtils ? reinterpret_cast<PFN_vk##name>(getInstanceProcAddr(instance, "vk" #name)) \
                    : nullptr;
  ALPENGLOW_OPTIONAL_FUNCTIONS(ALPENGLOW_LOAD)
#undef ALPENGLOW_LOAD
  return true;
}

}  // namespace alpenglow::engine
