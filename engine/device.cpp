#include "engine/device.h"

#include <algorithm>
#include <cinttypes>
#include <cstdarg>
#include <cstdio>
#include <new>

#include "engine/exceptions.h"
#include "engine/structure.h"
#include "engine/text.h"

namespace alpenglow::engine {
namespace {

constexpr size_t kMessageSize = 1024;

/// Reports for a device that doesn't exist yet.
Status refuse(const DeviceDesc& desc, Status status, const char* format, ...)
    ALPENGLOW_PRINTF(3, 4);
Status refuse(const DeviceDesc& desc, Status status, const char* format, ...) {
  char message[kMessageSize];
  va_list arguments;
  va_start(arguments, format);
  formatText(message, sizeof(message), format, arguments);
  va_end(arguments);
  if (desc.diagnostic != nullptr) {
    desc.diagnostic(desc.user, {Severity::Error, status, VK_SUCCESS, message});
  }
  return status;
}

Status checkHandles(const DeviceDesc& desc) {
  const char* missing = nullptr;
  if (desc.getInstanceProcAddr == nullptr) missing = "getInstanceProcAddr";
  if (desc.device == VK_NULL_HANDLE) missing = "device";
  if (desc.physicalDevice == VK_NULL_HANDLE) missing = "physicalDevice";
  if (desc.instance == VK_NULL_HANDLE) missing = "instance";
  if (missing != nullptr) {
    return refuse(desc, Status::InvalidArgument, "%s::%s is null, but the host's own is expected.",
                  desc.name, missing);
  }
  return Status::Ok;
}

Status checkQueueFamilies(const DeviceDesc& desc) {
  if (desc.queueFamilyCount > 0 && desc.queueFamilies == nullptr) {
    return refuse(desc, Status::InvalidArgument,
                  "%s::queueFamilies is null, but queueFamilyCount is %u.", desc.name,
                  desc.queueFamilyCount);
  }
  for (uint32_t i = 0; i < desc.queueFamilyCount; ++i) {
    for (uint32_t j = 0; j < i; ++j) {
      if (desc.queueFamilies[i] == desc.queueFamilies[j]) {
        return refuse(desc, Status::InvalidArgument,
                      "%s::queueFamilies names family %u twice, but each one is expected once.",
                      desc.name, desc.queueFamilies[i]);
      }
    }
  }
  return Status::Ok;
}

Status checkDesc(const DeviceDesc& desc) {
  if (Status status = checkHandles(desc); status != Status::Ok) return status;
  if (Status status = checkQueueFamilies(desc); status != Status::Ok) return status;
  if (desc.memory != nullptr &&
      (desc.memory->allocate == nullptr || desc.memory->free == nullptr)) {
    return refuse(desc, Status::InvalidArgument,
                  "%s::memory lacks its function %s, but both allocate and free are expected.",
                  desc.name, desc.memory->allocate == nullptr ? "allocate" : "free");
  }
  FeatureSet needed;
  needed.apiVersion = VK_API_VERSION_1_3;
  needed.synchronization2 = true;
  mergeFeatures(desc.needed, &needed);
  return checkEnabled(needed, desc.enabled, desc.name, desc.diagnostic, desc.user);
}

}  // namespace

void Counters::addBytes(uint64_t count) {
  const uint64_t now = bytes.fetch_add(count) + count;
  uint64_t peak = peakBytes.load();
  while (peak < now && !peakBytes.compare_exchange_weak(peak, now)) {
  }
}

Status Device::create(const DeviceDesc& desc, Device** out) {
  *out = nullptr;
  if (Status status = checkDesc(desc); status != Status::Ok) return status;
  Dispatch table;
  const char* missing = nullptr;
  if (!table.load(desc.getInstanceProcAddr, desc.instance, desc.device, desc.debugNames,
                  &missing)) {
    return refuse(desc, Status::Unsupported,
                  "The device doesn't offer the function %s, which Vulkan 1.3 has: the device and "
                  "VkApplicationInfo::apiVersion of the instance must both be at least 1.3.",
                  missing);
  }
  return create(desc, table, out);
}

Status Device::create(const DeviceDesc& desc, const Dispatch& table, Device** out) {
  *out = nullptr;
  if (Status status = checkDesc(desc); status != Status::Ok) return status;
  VkPhysicalDeviceProperties properties = {};
  table.GetPhysicalDeviceProperties(desc.physicalDevice, &properties);
  if (properties.apiVersion < VK_API_VERSION_1_3) {
    return refuse(desc, Status::Unsupported,
                  "The device \"%s\" has Vulkan %u.%u, but 1.3 or later is needed.",
                  properties.deviceName, VK_API_VERSION_MAJOR(properties.apiVersion),
                  VK_API_VERSION_MINOR(properties.apiVersion));
  }
  ALPENGLOW_TRY { *out = new Device(desc, table); }
  ALPENGLOW_CATCH_BAD_ALLOC {
    return refuse(desc, Status::OutOfHostMemory, "There is no host memory for a context.");
  }
  return Status::Ok;
}

Device::Device(const DeviceDesc& desc, const Dispatch& table)
    : desc_(desc), vk_(table), deletions_(*this) {
  if (desc.memory != nullptr) hooks_ = *desc.memory;
  queueFamilies_.assign(desc.queueFamilies, desc.queueFamilies + desc.queueFamilyCount);
  if (desc.shaders != nullptr) shaderReplacement_ = *desc.shaders;
  // They point at the host's memory, which needn't outlive the call.
  desc_.shaders = nullptr;
  desc_.memory = nullptr;
  desc_.queueFamilies = nullptr;
  vk_.GetPhysicalDeviceProperties(desc_.physicalDevice, &properties_);
  vk_.GetPhysicalDeviceMemoryProperties(desc_.physicalDevice, &memoryProperties_);
}

void Device::destroy(Device* device) {
  if (device == nullptr) return;
  device->deletions_.destroyAll();
  const uint64_t images = device->counters_.images, buffers = device->counters_.buffers;
  const uint64_t bytes = device->counters_.bytes;
  if (images != 0 || buffers != 0 || bytes != 0) {
    device->notice(Severity::Warning,
                   "The context is destroyed while %" PRIu64 " images, %" PRIu64
                   " buffers and %" PRIu64 " bytes of it are still alive.",
                   images, buffers, bytes);
  }
  delete device;
}

VkFormatProperties Device::formatProperties(VkFormat format) const {
  VkFormatProperties properties = {};
  vk_.GetPhysicalDeviceFormatProperties(desc_.physicalDevice, format, &properties);
  return properties;
}

void Device::report(Severity severity, Status status, VkResult result, const char* message) const {
  if (desc_.diagnostic != nullptr) {
    desc_.diagnostic(desc_.user, {severity, status, result, message});
  }
}

Status Device::fail(Status status, VkResult result, const char* format, ...) const {
  char message[kMessageSize];
  va_list arguments;
  va_start(arguments, format);
  formatText(message, sizeof(message), format, arguments);
  va_end(arguments);
  report(Severity::Error, status, result, message);
  return status;
}

Status Device::failVk(VkResult result, const char* what) const {
  if (result >= 0) return Status::Ok;
  return fail(statusOf(result), result, "%s returned %s (%d).", what, resultName(result), result);
}

Status Device::failVk(VkResult result, const char* call, const char* kind, const char* name) const {
  if (result >= 0) return Status::Ok;
  return fail(statusOf(result), result, "%s for %s \"%s\" returned %s (%d).", call, kind, name,
              resultName(result), result);
}

void Device::notice(Severity severity, const char* format, ...) const {
  char message[kMessageSize];
  va_list arguments;
  va_start(arguments, format);
  formatText(message, sizeof(message), format, arguments);
  va_end(arguments);
  report(severity, Status::Ok, VK_SUCCESS, message);
}

void Device::setName(VkObjectType type, uint64_t handle, const char* name) const {
  if (vk_.SetDebugUtilsObjectNameEXT == nullptr || handle == 0) return;
  auto info =
      structure<VkDebugUtilsObjectNameInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT);
  info.objectType = type;
  info.objectHandle = handle;
  info.pObjectName = name;
  // A name that can't be set is no reason to fail.
  (void)vk_.SetDebugUtilsObjectNameEXT(desc_.device, &info);
}

void Device::beginLabel(VkCommandBuffer commandBuffer, const char* name) const {
  if (vk_.CmdBeginDebugUtilsLabelEXT == nullptr) return;
  auto label = structure<VkDebugUtilsLabelEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT);
  label.pLabelName = name;
  vk_.CmdBeginDebugUtilsLabelEXT(commandBuffer, &label);
}

void Device::endLabel(VkCommandBuffer commandBuffer) const {
  if (vk_.CmdEndDebugUtilsLabelEXT != nullptr) vk_.CmdEndDebugUtilsLabelEXT(commandBuffer);
}

void Device::destroyObject(VkObjectType type, uint64_t handle) {
  if (handle == 0) return;
  switch (type) {
#define ALPENGLOW_DESTROY(objectType, name)                                         \
  case objectType:                                                                  \
    vk_.Destroy##name(desc_.device, handleFrom<Vk##name>(handle), desc_.allocator); \
    break;
    ALPENGLOW_DESTROY(VK_OBJECT_TYPE_IMAGE, Image)
    ALPENGLOW_DESTROY(VK_OBJECT_TYPE_IMAGE_VIEW, ImageView)
    ALPENGLOW_DESTROY(VK_OBJECT_TYPE_BUFFER, Buffer)
    ALPENGLOW_DESTROY(VK_OBJECT_TYPE_PIPELINE, Pipeline)
    ALPENGLOW_DESTROY(VK_OBJECT_TYPE_PIPELINE_LAYOUT, PipelineLayout)
    ALPENGLOW_DESTROY(VK_OBJECT_TYPE_SHADER_MODULE, ShaderModule)
    ALPENGLOW_DESTROY(VK_OBJECT_TYPE_SAMPLER, Sampler)
    ALPENGLOW_DESTROY(VK_OBJECT_TYPE_DESCRIPTOR_POOL, DescriptorPool)
    ALPENGLOW_DESTROY(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, DescriptorSetLayout)
#undef ALPENGLOW_DESTROY
    default:
      (void)fail(Status::InvalidArgument, VK_SUCCESS,
                 "An object of VkObjectType %d can't be destroyed: the type is not one that the "
                 "library makes.",
                 static_cast<int>(type));
      return;
  }
  if (type == VK_OBJECT_TYPE_IMAGE) --counters_.images;
  if (type == VK_OBJECT_TYPE_BUFFER) --counters_.buffers;
}

void Device::countPipeline(uint64_t variantKey) {
  ++counters_.pipelines;
  const std::lock_guard<std::mutex> lock(variantsMutex_);
  const auto place = std::lower_bound(variants_.begin(), variants_.end(), variantKey);
  if (place != variants_.end() && *place == variantKey) return;
  ++counters_.shaderVariants;
  ALPENGLOW_TRY { variants_.insert(place, variantKey); }
  ALPENGLOW_CATCH_BAD_ALLOC {
    // Without memory for the key, an equal pipeline made later is counted again: a figure in a
    // report, not worth failing a pipeline that works.
  }
}

}  // namespace alpenglow::engine
