#include "tests/passes/sky/vulkan_wrap.h"

#include <cstring>
#include <vector>

namespace alpenglow::testing {
namespace {

VulkanWrap* current = nullptr;

/// Stands in for a function that returns VkResult. One type for each: the index makes it so.
template <class Function, int kIndex>
struct Fallible;

template <class... Arguments, int kIndex>
struct Fallible<VkResult(VKAPI_PTR*)(Arguments...), kIndex> {
  static inline VkResult(VKAPI_PTR* real)(Arguments...) = nullptr;
  static inline const char* name = "";
  static VKAPI_ATTR VkResult VKAPI_CALL call(Arguments... arguments) {
    return current->failsNow(name) ? current->failWith : real(arguments...);
  }
};

// clang-format off
#define ALPENGLOW_FALLIBLE_FUNCTIONS(X) \
  X(AllocateDescriptorSets)             \
  X(AllocateMemory)                     \
  X(BindBufferMemory)                   \
  X(BindImageMemory)                    \
  X(CreateBuffer)                       \
  X(CreateComputePipelines)             \
  X(CreateDescriptorPool)               \
  X(CreateDescriptorSetLayout)          \
  X(CreateImage)                        \
  X(CreateImageView)                    \
  X(CreatePipelineLayout)               \
  X(CreateSampler)                      \
  X(CreateShaderModule)                 \
  X(MapMemory)
// clang-format on

PFN_vkCreateGraphicsPipelines realCreateGraphicsPipelines = nullptr;

/// A copy of a stage's specialization whose values may be changed.
struct Specialization {
  std::vector<uint32_t> values;
  VkSpecializationInfo info = {};
};

void force(const VkPipelineShaderStageCreateInfo& stage, Specialization* out) {
  out->info = *stage.pSpecializationInfo;
  out->values.resize(out->info.dataSize / sizeof(uint32_t));
  std::memcpy(out->values.data(), out->info.pData, out->info.dataSize);
  out->info.pData = out->values.data();
  for (uint32_t i = 0; i < out->info.mapEntryCount; ++i) {
    const VkSpecializationMapEntry& entry = out->info.pMapEntries[i];
    const auto forced = current->forcedConstants.find(entry.constantID);
    if (forced != current->forcedConstants.end()) out->values[entry.offset / 4] = forced->second;
  }
}

VKAPI_ATTR VkResult VKAPI_CALL createGraphicsPipelines(VkDevice device, VkPipelineCache cache,
                                                       uint32_t count,
                                                       const VkGraphicsPipelineCreateInfo* infos,
                                                       const VkAllocationCallbacks* allocator,
                                                       VkPipeline* out) {
  if (current->failsNow("vkCreateGraphicsPipelines")) return current->failWith;
  const bool changes =
      !current->forcedConstants.empty() || current->forcedFragment != VK_NULL_HANDLE;
  if (!changes || count != 1)
    return realCreateGraphicsPipelines(device, cache, count, infos, allocator, out);
  VkGraphicsPipelineCreateInfo info = infos[0];
  std::vector<VkPipelineShaderStageCreateInfo> stages(info.pStages, info.pStages + info.stageCount);
  std::vector<Specialization> specializations(info.stageCount);
  for (uint32_t i = 0; i < info.stageCount; ++i) {
    if (current->forcedFragment != VK_NULL_HANDLE &&
        stages[i].stage == VK_SHADER_STAGE_FRAGMENT_BIT)
      stages[i].module = current->forcedFragment;
    if (stages[i].pSpecializationInfo == nullptr) continue;
    force(stages[i], &specializations[i]);
    stages[i].pSpecializationInfo = &specializations[i].info;
  }
  info.pStages = stages.data();
  return realCreateGraphicsPipelines(device, cache, 1, &info, allocator, out);
}

template <class Function, int kIndex>
PFN_vkVoidFunction wrap(PFN_vkVoidFunction real, const char* name) {
  using Stand = Fallible<Function, kIndex>;
  Stand::real = reinterpret_cast<Function>(real);
  Stand::name = name;
  return reinterpret_cast<PFN_vkVoidFunction>(&Stand::call);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getDeviceProcAddr(VkDevice device, const char* name) {
  const PFN_vkVoidFunction real = current->realGetDeviceProcAddr(device, name);
  if (real == nullptr) return nullptr;
  // Two functions of one type must not share a stand-in, hence the counter.
  constexpr int kFirst = __COUNTER__;
#define ALPENGLOW_WRAP(function)              \
  if (std::strcmp(name, "vk" #function) == 0) \
    return wrap<PFN_vk##function, __COUNTER__ - kFirst>(real, "vk" #function);
  ALPENGLOW_FALLIBLE_FUNCTIONS(ALPENGLOW_WRAP)
#undef ALPENGLOW_WRAP
  if (std::strcmp(name, "vkCreateGraphicsPipelines") == 0) {
    realCreateGraphicsPipelines = reinterpret_cast<PFN_vkCreateGraphicsPipelines>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(&createGraphicsPipelines);
  }
  return real;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL getInstanceProcAddrOfWrap(VkInstance instance,
                                                                   const char* name) {
  const PFN_vkVoidFunction real = current->realGetInstanceProcAddr(instance, name);
  if (real != nullptr && std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
    current->realGetDeviceProcAddr = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(&getDeviceProcAddr);
  }
  return real;
}

}  // namespace

VulkanWrap::VulkanWrap(PFN_vkGetInstanceProcAddr real)
    : realGetInstanceProcAddr(real), previous_(current) {
  current = this;
}

VulkanWrap::~VulkanWrap() { current = previous_; }

PFN_vkGetInstanceProcAddr VulkanWrap::getInstanceProcAddr() const {
  return &getInstanceProcAddrOfWrap;
}

bool VulkanWrap::failsNow(const char* name) {
  ++calls[name];
  const bool fails = fallibleCalls++ == failAt;
  if (fails) failedCall = name;
  return fails;
}

}  // namespace alpenglow::testing
