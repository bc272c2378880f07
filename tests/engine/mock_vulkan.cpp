#include "tests/engine/mock_vulkan.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace alpenglow::testing {
namespace {

using engine::handleFrom;
using engine::handleNumber;

MockVulkan* g_current = nullptr;

// clang-format off
#define MOCK_OBJECTS(X) \
  X(Buffer, VkBufferCreateInfo) X(DescriptorSetLayout, VkDescriptorSetLayoutCreateInfo) \
  X(ImageView, VkImageViewCreateInfo) X(PipelineLayout, VkPipelineLayoutCreateInfo) \
  X(Sampler, VkSamplerCreateInfo) X(ShaderModule, VkShaderModuleCreateInfo)
#define MOCK_DESTROYED(X) \
  X(Buffer) X(DescriptorPool) X(DescriptorSetLayout) X(Image) X(ImageView) X(Pipeline) \
  X(PipelineLayout) X(Sampler) X(ShaderModule)
// clang-format on

#define MOCK_CREATE(name, info)                                                                    \
  VkResult create##name(VkDevice, const info*, const VkAllocationCallbacks* with, Vk##name* out) { \
    const VkResult result = g_current->attempt("vkCreate" #name);                                  \
    if (result == VK_SUCCESS) *out = handleFrom<Vk##name>(g_current->make(#name, with));           \
    return result;                                                                                 \
  }
MOCK_OBJECTS(MOCK_CREATE)

#define MOCK_DESTROY(name)                                                           \
  void destroy##name(VkDevice, Vk##name handle, const VkAllocationCallbacks* with) { \
    g_current->calls.push_back("vkDestroy" #name);                                   \
    g_current->unmake(#name, handleNumber(handle), with);                            \
  }
MOCK_DESTROYED(MOCK_DESTROY)

VkResult createImage(VkDevice, const VkImageCreateInfo* info, const VkAllocationCallbacks* with,
                     VkImage* out) {
  const VkResult result = g_current->attempt("vkCreateImage");
  if (result != VK_SUCCESS) return result;
  g_current->imageInfos.push_back(*info);
  *out = handleFrom<VkImage>(g_current->make("Image", with));
  return result;
}

VkResult createDescriptorPool(VkDevice, const VkDescriptorPoolCreateInfo* info,
                              const VkAllocationCallbacks* with, VkDescriptorPool* out) {
  const VkResult result = g_current->attempt("vkCreateDescriptorPool");
  if (result != VK_SUCCESS) return result;
  g_current->poolSets = info->maxSets;
  g_current->poolSizes.assign(info->pPoolSizes, info->pPoolSizes + info->poolSizeCount);
  *out = handleFrom<VkDescriptorPool>(g_current->make("DescriptorPool", with));
  return result;
}

template <class Info>
VkResult createPipelines(const char* call, uint32_t count, const Info*,
                         const VkAllocationCallbacks* with, VkPipeline* out) {
  const VkResult result = g_current->attempt(call);
  for (uint32_t i = 0; i < count; ++i) {
    out[i] = result == VK_SUCCESS ? handleFrom<VkPipeline>(g_current->make("Pipeline", with))
                                  : VK_NULL_HANDLE;
  }
  return result;
}

VkResult createComputePipelines(VkDevice, VkPipelineCache, uint32_t count,
                                const VkComputePipelineCreateInfo* infos,
                                const VkAllocationCallbacks* with, VkPipeline* out) {
  return createPipelines("vkCreateComputePipelines", count, infos, with, out);
}

VkResult createGraphicsPipelines(VkDevice, VkPipelineCache, uint32_t count,
                                 const VkGraphicsPipelineCreateInfo* infos,
                                 const VkAllocationCallbacks* with, VkPipeline* out) {
  return createPipelines("vkCreateGraphicsPipelines", count, infos, with, out);
}

VkResult allocateDescriptorSets(VkDevice, const VkDescriptorSetAllocateInfo* info,
                                VkDescriptorSet* out) {
  const VkResult result = g_current->attempt("vkAllocateDescriptorSets");
  for (uint32_t i = 0; i < info->descriptorSetCount; ++i) {
    out[i] = handleFrom<VkDescriptorSet>(result == VK_SUCCESS ? 77 + i : 66);
  }
  return result;
}

void updateDescriptorSets(VkDevice, uint32_t count, const VkWriteDescriptorSet* writes, uint32_t,
                          const VkCopyDescriptorSet*) {
  g_current->calls.emplace_back("vkUpdateDescriptorSets");
  g_current->descriptorWrites.assign(writes, writes + count);
}

VkResult allocateMemory(VkDevice, const VkMemoryAllocateInfo* info,
                        const VkAllocationCallbacks* with, VkDeviceMemory* out) {
  const VkResult result = g_current->attempt("vkAllocateMemory");
  if (result != VK_SUCCESS) return result;
  g_current->allocations.push_back(*info);
  *out = handleFrom<VkDeviceMemory>(g_current->make("DeviceMemory", with));
  return result;
}

void freeMemory(VkDevice, VkDeviceMemory memory, const VkAllocationCallbacks* with) {
  g_current->calls.emplace_back("vkFreeMemory");
  g_current->unmake("DeviceMemory", handleNumber(memory), with);
}

VkResult mapMemory(VkDevice, VkDeviceMemory, VkDeviceSize, VkDeviceSize size, VkMemoryMapFlags,
                   void** data) {
  const VkResult result = g_current->attempt("vkMapMemory");
  if (result != VK_SUCCESS) return result;
  g_current->mapped.resize(size);
  *data = g_current->mapped.data();
  return result;
}

void unmapMemory(VkDevice, VkDeviceMemory) { g_current->calls.emplace_back("vkUnmapMemory"); }

VkResult bindImageMemory(VkDevice, VkImage, VkDeviceMemory memory, VkDeviceSize offset) {
  const VkResult result = g_current->attempt("vkBindImageMemory");
  if (result == VK_SUCCESS) g_current->bindings.push_back({memory, offset});
  return result;
}

VkResult bindBufferMemory(VkDevice, VkBuffer, VkDeviceMemory memory, VkDeviceSize offset) {
  const VkResult result = g_current->attempt("vkBindBufferMemory");
  if (result == VK_SUCCESS) g_current->bindings.push_back({memory, offset});
  return result;
}

/// The requirements of the N-th object of its kind, N by the order of handles.
VkMemoryRequirements pick(const std::vector<VkMemoryRequirements>& list, const char* kind,
                          uint64_t handle) {
  size_t index = 0;
  for (const auto& [other, otherKind] : g_current->alive) {
    if (other < handle && otherKind == kind) ++index;
  }
  return list[std::min(index, list.size() - 1)];
}

void getImageMemoryRequirements(VkDevice, VkImage image, VkMemoryRequirements* out) {
  *out = pick(g_current->imageRequirements, "Image", handleNumber(image));
}

void getBufferMemoryRequirements(VkDevice, VkBuffer buffer, VkMemoryRequirements* out) {
  *out = pick(g_current->bufferRequirements, "Buffer", handleNumber(buffer));
}

void cmdPipelineBarrier2(VkCommandBuffer, const VkDependencyInfo* info) {
  g_current->calls.emplace_back("vkCmdPipelineBarrier2");
  g_current->imageBarriers.assign(info->pImageMemoryBarriers,
                                  info->pImageMemoryBarriers + info->imageMemoryBarrierCount);
  g_current->memoryBarriers.assign(info->pMemoryBarriers,
                                   info->pMemoryBarriers + info->memoryBarrierCount);
}

void getPhysicalDeviceProperties(VkPhysicalDevice, VkPhysicalDeviceProperties* out) {
  *out = g_current->properties;
}

void getPhysicalDeviceMemoryProperties(VkPhysicalDevice, VkPhysicalDeviceMemoryProperties* out) {
  *out = g_current->memory;
}

void getPhysicalDeviceFormatProperties(VkPhysicalDevice, VkFormat, VkFormatProperties* out) {
  *out = {};
  out->optimalTilingFeatures = g_current->formatFeatures;
}

VkResult getPhysicalDeviceImageFormatProperties(VkPhysicalDevice, VkFormat, VkImageType,
                                                VkImageTiling, VkImageUsageFlags,
                                                VkImageCreateFlags, VkImageFormatProperties* out) {
  const VkResult result = g_current->attempt("vkGetPhysicalDeviceImageFormatProperties");
  *out = {g_current->maxExtent, 15, 2048, VK_SAMPLE_COUNT_1_BIT, UINT64_MAX};
  return result;
}

void getPhysicalDeviceFeatures2(VkPhysicalDevice, VkPhysicalDeviceFeatures2* out) {
  out->features = g_current->features;
  auto* next = static_cast<VkBaseOutStructure*>(out->pNext);
  if (next != nullptr && next->sType == VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES) {
    auto* features13 = reinterpret_cast<VkPhysicalDeviceVulkan13Features*>(next);
    features13->synchronization2 = g_current->synchronization2 ? VK_TRUE : VK_FALSE;
    features13->dynamicRendering = g_current->dynamicRendering ? VK_TRUE : VK_FALSE;
  }
}

VkResult enumerateInstanceVersion(uint32_t* version) {
  *version = g_current->loaderVersion;
  return VK_SUCCESS;
}

void unexpected() {
  std::fprintf(stderr, "A Vulkan function that the mock doesn't have was called.\n");
  std::abort();
}

PFN_vkVoidFunction getDeviceProcAddr(VkDevice, const char* name);

/// The mock's function of this name; a function that aborts where it has none.
PFN_vkVoidFunction find(const char* name) {
  if (g_current->missingFunction == name) return nullptr;
#define MOCK_FIND(type, function) \
  if (std::strcmp(name, "vk" #type) == 0) return reinterpret_cast<PFN_vkVoidFunction>(&function);
#define MOCK_FIND_CREATE(name, info) MOCK_FIND(Create##name, create##name)
#define MOCK_FIND_DESTROY(name) MOCK_FIND(Destroy##name, destroy##name)
  MOCK_OBJECTS(MOCK_FIND_CREATE)
  MOCK_DESTROYED(MOCK_FIND_DESTROY)
  MOCK_FIND(CreateImage, createImage)
  MOCK_FIND(CreateDescriptorPool, createDescriptorPool)
  MOCK_FIND(CreateComputePipelines, createComputePipelines)
  MOCK_FIND(CreateGraphicsPipelines, createGraphicsPipelines)
  MOCK_FIND(AllocateDescriptorSets, allocateDescriptorSets)
  MOCK_FIND(UpdateDescriptorSets, updateDescriptorSets)
  MOCK_FIND(AllocateMemory, allocateMemory)
  MOCK_FIND(FreeMemory, freeMemory)
  MOCK_FIND(MapMemory, mapMemory)
  MOCK_FIND(UnmapMemory, unmapMemory)
  MOCK_FIND(BindImageMemory, bindImageMemory)
  MOCK_FIND(BindBufferMemory, bindBufferMemory)
  MOCK_FIND(GetImageMemoryRequirements, getImageMemoryRequirements)
  MOCK_FIND(GetBufferMemoryRequirements, getBufferMemoryRequirements)
  MOCK_FIND(CmdPipelineBarrier2, cmdPipelineBarrier2)
  MOCK_FIND(GetPhysicalDeviceProperties, getPhysicalDeviceProperties)
  MOCK_FIND(GetPhysicalDeviceMemoryProperties, getPhysicalDeviceMemoryProperties)
  MOCK_FIND(GetPhysicalDeviceFormatProperties, getPhysicalDeviceFormatProperties)
  MOCK_FIND(GetPhysicalDeviceImageFormatProperties, getPhysicalDeviceImageFormatProperties)
  MOCK_FIND(GetPhysicalDeviceFeatures2, getPhysicalDeviceFeatures2)
  MOCK_FIND(EnumerateInstanceVersion, enumerateInstanceVersion)
  MOCK_FIND(GetDeviceProcAddr, getDeviceProcAddr)
  return reinterpret_cast<PFN_vkVoidFunction>(&unexpected);
}

PFN_vkVoidFunction getDeviceProcAddr(VkDevice, const char* name) { return find(name); }
PFN_vkVoidFunction getInstanceProcAddr(VkInstance, const char* name) { return find(name); }

void onDiagnostic(void* user, const Diagnostic& diagnostic) {
  auto* mock = static_cast<MockVulkan*>(user);
  mock->diagnostics.emplace_back(diagnostic.message);
  mock->diagnosticValues.push_back(diagnostic);
}

}  // namespace

MockVulkan::MockVulkan() {
  g_current = this;
  properties.apiVersion = VK_API_VERSION_1_3;
  std::snprintf(properties.deviceName, sizeof(properties.deviceName), "mock");
  properties.limits.bufferImageGranularity = 1;
  properties.limits.maxPushConstantsSize = 128;
  memory.memoryTypeCount = 2;
  memory.memoryTypes[0].propertyFlags = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
  memory.memoryTypes[1].propertyFlags =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  memory.memoryHeapCount = 1;
  imageRequirements = {{1000, 256, 3}};
  bufferRequirements = {{100, 16, 3}};
}

MockVulkan::~MockVulkan() { g_current = nullptr; }

MockVulkan& MockVulkan::current() { return *g_current; }

engine::DeviceDesc MockVulkan::deviceDesc() {
  engine::DeviceDesc desc;
  desc.name = "ContextDesc";
  desc.instance = handleFrom<VkInstance>(1);
  desc.physicalDevice = handleFrom<VkPhysicalDevice>(2);
  desc.device = handleFrom<VkDevice>(3);
  desc.getInstanceProcAddr = getInstanceProcAddr;
  desc.enabled.apiVersion = VK_API_VERSION_1_3;
  desc.enabled.synchronization2 = true;
  desc.enabled.dynamicRendering = true;
  desc.allocator = allocator;
  desc.diagnostic = onDiagnostic;
  desc.user = this;
  return desc;
}

engine::Dispatch MockVulkan::table() const {
  engine::Dispatch result;
  result.load(getInstanceProcAddr, handleFrom<VkInstance>(1), handleFrom<VkDevice>(3), false,
              nullptr);
  return result;
}

engine::Device* MockVulkan::makeDevice() {
  engine::Device* device = nullptr;
  const Status status = engine::Device::create(deviceDesc(), &device);
  if (status != Status::Ok) mistakes.emplace_back("The mock device can't be made.");
  return device;
}

VkResult MockVulkan::attempt(const char* call) {
  calls.emplace_back(call);
  if (fallibleCalls++ != failAt) return VK_SUCCESS;
  failedCall = call;
  return failWith;
}

void MockVulkan::checkAllocator(const char* what, const VkAllocationCallbacks* with) {
  if (with != allocator) mistakes.push_back(std::string(what) + " has a foreign allocator");
}

uint64_t MockVulkan::make(const char* kind, const VkAllocationCallbacks* with) {
  checkAllocator(kind, with);
  const uint64_t handle = nextHandle_++;
  alive[handle] = kind;
  if (with != nullptr) {
    hostMemory_[handle] =
        with->pfnAllocation(with->pUserData, 16, 8, VK_SYSTEM_ALLOCATION_SCOPE_OBJECT);
  }
  return handle;
}

void MockVulkan::unmake(const char* kind, uint64_t handle, const VkAllocationCallbacks* with) {
  checkAllocator(kind, with);
  const auto found = alive.find(handle);
  if (found == alive.end() || found->second != kind) {
    mistakes.push_back(std::string(kind) + " destroyed that is not alive");
    return;
  }
  alive.erase(found);
  destroyed.emplace_back(kind);
  if (with != nullptr) with->pfnFree(with->pUserData, hostMemory_[handle]);
}

int MockVulkan::count(const std::string& call) const {
  return static_cast<int>(std::count(calls.begin(), calls.end(), call));
}

int MockVulkan::aliveCount(const std::string& kind) const {
  return static_cast<int>(std::count_if(alive.begin(), alive.end(),
                                        [&](const auto& entry) { return entry.second == kind; }));
}

const std::string& MockVulkan::lastDiagnostic() const {
  static const std::string kNone;
  return diagnostics.empty() ? kNone : diagnostics.back();
}

}  // namespace alpenglow::testing
