#include <alpenglow/headless.h>

#include "engine/headless/impl.h"
#include "engine/headless/platform.h"
#include "engine/structure.h"

namespace alpenglow::headless {

using engine::structure;

Device::Impl::~Impl() {
  if (device == VK_NULL_HANDLE) return;
  vk().DeviceWaitIdle(device);
  vk().DestroyQueryPool(device, queries, nullptr);
  vk().DestroyFence(device, fence, nullptr);
  vk().DestroyCommandPool(device, commandPool, nullptr);
  vk().DestroyDevice(device, nullptr);
}

bool Device::Impl::createDevice(const DeviceOptions& options, std::string* error) {
  const float priority = 1.0f;
  auto queueInfo = structure<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
  queueInfo.queueFamilyIndex = selection.queueFamily;
  queueInfo.queueCount = 1;
  queueInfo.pQueuePriorities = &priority;
  auto features13 = structure<VkPhysicalDeviceVulkan13Features>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
  const DeviceFeatureFlags newer = selection.enabled.deviceFeatures;
  features13.synchronization2 = (newer & kFeatureSynchronization2) != 0 ? VK_TRUE : VK_FALSE;
  features13.dynamicRendering = (newer & kFeatureDynamicRendering) != 0 ? VK_TRUE : VK_FALSE;
  auto features =
      structure<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  if (selection.enabled.apiVersion >= VK_API_VERSION_1_3) features.pNext = &features13;
  features.features = selection.enabled.features;
  auto info = structure<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
  info.pNext = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queueInfo;
  std::vector<const char*> extensions;
  for (const std::string& extension : options.deviceExtensions) {
    extensions.push_back(extension.c_str());
  }
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  const VkResult result = vk().CreateDevice(selection.physicalDevice, &info, nullptr, &device);
  if (result < 0) {
    device = VK_NULL_HANDLE;
    return setError(error, resultSentence("vkCreateDevice", result));
  }
  if (const char* missing = instance->vk().loadDevice(device)) {
    // Nothing else was made on it, and the destructor needs the whole table.
    if (vk().DestroyDevice != nullptr) vk().DestroyDevice(device, nullptr);
    device = VK_NULL_HANDLE;
    return setError(error, "The device \"" + name + "\" has no function " + missing + ".");
  }
  vk().GetDeviceQueue(device, selection.queueFamily, 0, &queue);
  return true;
}

bool Device::Impl::createCommands(std::string* error) {
  auto poolInfo = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
  poolInfo.queueFamilyIndex = selection.queueFamily;
  VkResult result = vk().CreateCommandPool(device, &poolInfo, nullptr, &commandPool);
  if (result < 0) return setError(error, resultSentence("vkCreateCommandPool", result));

  auto bufferInfo =
      structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
  bufferInfo.commandPool = commandPool;
  bufferInfo.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  bufferInfo.commandBufferCount = 1;
  result = vk().AllocateCommandBuffers(device, &bufferInfo, &commandBuffer);
  if (result < 0) return setError(error, resultSentence("vkAllocateCommandBuffers", result));

  const auto fenceInfo = structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  result = vk().CreateFence(device, &fenceInfo, nullptr, &fence);
  if (result < 0) return setError(error, resultSentence("vkCreateFence", result));

  if (selection.timestampBits == 0) return true;
  auto queryInfo = structure<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
  queryInfo.queryType = VK_QUERY_TYPE_TIMESTAMP;
  queryInfo.queryCount = 2;
  result = vk().CreateQueryPool(device, &queryInfo, nullptr, &queries);
  if (result < 0) return setError(error, resultSentence("vkCreateQueryPool", result));
  return true;
}

Device::Device() : impl_(std::make_unique<Impl>()) {}
Device::~Device() = default;

std::unique_ptr<Device> Device::create(const DeviceOptions& options, std::string* error) {
  std::unique_ptr<Device> device(new Device());
  Impl& impl = *device->impl_;
  impl.instance = Instance::create(options, error);
  if (impl.instance == nullptr) return nullptr;
  if (!selectDevice(*impl.instance, options, &impl.selection, error)) return nullptr;
  VkPhysicalDeviceProperties properties = {};
  impl.vk().GetPhysicalDeviceProperties(impl.selection.physicalDevice, &properties);
  impl.vk().GetPhysicalDeviceMemoryProperties(impl.selection.physicalDevice, &impl.memory);
  impl.name = properties.deviceName;
  impl.timestampPeriod = properties.limits.timestampPeriod;
  if (!impl.createDevice(options, error) || !impl.createCommands(error)) return nullptr;
  return device;
}

void Device::waitIdle() const { impl_->vk().DeviceWaitIdle(impl_->device); }

PFN_vkGetInstanceProcAddr Device::getInstanceProcAddr() const {
  return impl_->instance->getInstanceProcAddr();
}
VkInstance Device::instance() const { return impl_->instance->handle(); }
VkPhysicalDevice Device::physicalDevice() const { return impl_->selection.physicalDevice; }
VkDevice Device::device() const { return impl_->device; }
VkQueue Device::queue() const { return impl_->queue; }
uint32_t Device::queueFamily() const { return impl_->selection.queueFamily; }
const Requirements& Device::enabled() const { return impl_->selection.enabled; }
const std::string& Device::name() const { return impl_->name; }
bool Device::debugUtils() const { return impl_->instance->validation(); }

ContextDesc Device::contextDesc() const {
  ContextDesc desc;
  desc.instance = instance();
  desc.physicalDevice = physicalDevice();
  desc.device = device();
  desc.getInstanceProcAddr = getInstanceProcAddr();
  desc.enabled = enabled();
  desc.queueFamilies = &impl_->selection.queueFamily;
  desc.queueFamilyCount = 1;
  desc.debugNames = debugUtils();
  return desc;
}

uint64_t Device::frame() const { return impl_->completedFrame + 1; }

uint64_t Device::skipFrame() { return ++impl_->completedFrame + 1; }

PFN_vkVoidFunction Device::function(const char* name) const {
  return impl_->vk().GetDeviceProcAddr(impl_->device, name);
}

std::vector<std::string> Device::validationMessages() const {
  return impl_->instance->log().messages();
}

void Device::clearValidationMessages() { impl_->instance->log().clear(); }

bool Device::run(const std::function<bool(VkCommandBuffer)>& record, std::string* error,
                 Timing* timing) {
  Impl& impl = *impl_;
  const Functions& vk = impl.vk();
  VkResult result = vk.ResetCommandPool(impl.device, impl.commandPool, 0);
  if (result < 0) return setError(error, resultSentence("vkResetCommandPool", result));
  auto begin = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  result = vk.BeginCommandBuffer(impl.commandBuffer, &begin);
  if (result < 0) return setError(error, resultSentence("vkBeginCommandBuffer", result));

  const bool timestamps = timing != nullptr && impl.queries != VK_NULL_HANDLE;
  if (timestamps) {
    vk.CmdResetQueryPool(impl.commandBuffer, impl.queries, 0, 2);
    vk.CmdWriteTimestamp(impl.commandBuffer, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT, impl.queries, 0);
  }
  if (!record(impl.commandBuffer)) return false;
  if (timestamps) {
    vk.CmdWriteTimestamp(impl.commandBuffer, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, impl.queries, 1);
  }
  result = vk.EndCommandBuffer(impl.commandBuffer);
  if (result < 0) return setError(error, resultSentence("vkEndCommandBuffer", result));
  return impl.submitAndWait(error, timing);
}

bool Device::Impl::submitAndWait(std::string* error, Timing* timing) {
  VkResult result = vk().ResetFences(device, 1, &fence);
  if (result < 0) return setError(error, resultSentence("vkResetFences", result));
  auto submit = structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commandBuffer;
  const double start = userSeconds();
  result = vk().QueueSubmit(queue, 1, &submit, fence);
  if (result < 0) return setError(error, resultSentence("vkQueueSubmit", result));
  result = vk().WaitForFences(device, 1, &fence, VK_TRUE, UINT64_MAX);
  if (result < 0) return setError(error, resultSentence("vkWaitForFences", result));
  const double end = userSeconds();
  ++completedFrame;
  if (timing != nullptr) *timing = {end - start, gpuSeconds()};
  return true;
}

double Device::Impl::gpuSeconds() const {
  uint64_t ticks[2] = {};
  if (queries == VK_NULL_HANDLE ||
      vk().GetQueryPoolResults(device, queries, 0, 2, sizeof(ticks), ticks, sizeof(ticks[0]),
                               VK_QUERY_RESULT_64_BIT) != VK_SUCCESS) {
    return -1.0;
  }
  const uint32_t bits = selection.timestampBits;
  const uint64_t mask = bits >= 64 ? UINT64_MAX : (uint64_t{1} << bits) - 1;
  // Modulo the counter's width: it may wrap between the two.
  const uint64_t elapsed = (ticks[1] - ticks[0]) & mask;
  return static_cast<double>(elapsed) * static_cast<double>(timestampPeriod) * 1e-9;
}

std::vector<std::string> listDevices(std::string* error) {
  const std::unique_ptr<Instance> instance = Instance::create({}, error);
  if (instance == nullptr) return {};
  std::vector<std::string> names;
  for (VkPhysicalDevice device : instance->physicalDevices(error)) {
    names.push_back(instance->nameOf(device));
  }
  return names;
}

}  // namespace alpenglow::headless
