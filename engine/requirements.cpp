#include "engine/requirements.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "engine/structure.h"

namespace alpenglow::engine {
namespace {

// clang-format off
#define ALPENGLOW_CORE_FEATURES(X) \
  X(robustBufferAccess) X(fullDrawIndexUint32) X(imageCubeArray) X(independentBlend) \
  X(geometryShader) X(tessellationShader) X(sampleRateShading) X(dualSrcBlend) X(logicOp) \
  X(multiDrawIndirect) X(drawIndirectFirstInstance) X(depthClamp) X(depthBiasClamp) \
  X(fillModeNonSolid) X(depthBounds) X(wideLines) X(largePoints) X(alphaToOne) X(multiViewport) \
  X(samplerAnisotropy) X(textureCompressionETC2) X(textureCompressionASTC_LDR) \
  X(textureCompressionBC) X(occlusionQueryPrecise) X(pipelineStatisticsQuery) \
  X(vertexPipelineStoresAndAtomics) X(fragmentStoresAndAtomics) \
  X(shaderTessellationAndGeometryPointSize) X(shaderImageGatherExtended) \
  X(shaderStorageImageExtendedFormats) X(shaderStorageImageMultisample) \
  X(shaderStorageImageReadWithoutFormat) X(shaderStorageImageWriteWithoutFormat) \
  X(shaderUniformBufferArrayDynamicIndexing) X(shaderSampledImageArrayDynamicIndexing) \
  X(shaderStorageBufferArrayDynamicIndexing) X(shaderStorageImageArrayDynamicIndexing) \
  X(shaderClipDistance) X(shaderCullDistance) X(shaderFloat64) X(shaderInt64) X(shaderInt16) \
  X(shaderResourceResidency) X(shaderResourceMinLod) X(sparseBinding) X(sparseResidencyBuffer) \
  X(sparseResidencyImage2D) X(sparseResidencyImage3D) X(sparseResidency2Samples) \
  X(sparseResidency4Samples) X(sparseResidency8Samples) X(sparseResidency16Samples) \
  X(sparseResidencyAliased) X(variableMultisampleRate) X(inheritedQueries)
// clang-format on

struct Feature {
  const char* name;
  VkBool32 VkPhysicalDeviceFeatures::*member;
};
constexpr Feature kFeatures[] = {
#define ALPENGLOW_FEATURE(name) {#name, &VkPhysicalDeviceFeatures::name},
    ALPENGLOW_CORE_FEATURES(ALPENGLOW_FEATURE)
#undef ALPENGLOW_FEATURE
};
static_assert(sizeof(kFeatures) / sizeof(kFeatures[0]) ==
              sizeof(VkPhysicalDeviceFeatures) / sizeof(VkBool32));

/// A sentence that grows in a fixed buffer: an introduction, then gaps separated by commas.
class GapList {
 public:
  void add(const char* gap) {
    append(count_++ == 0 ? "" : ", ");
    append(gap);
  }
  bool empty() const { return count_ == 0; }
  const char* text() const { return text_; }

 private:
  void append(const char* part) {
    const size_t used = std::strlen(text_);
    std::snprintf(text_ + used, sizeof(text_) - used, "%s", part);
  }

  char text_[2048] = "";
  int count_ = 0;
};

/// `what` stands before "Vulkan".
void addVersionGap(const char* what, uint32_t needed, uint32_t offered, GapList* gaps) {
  if (offered >= needed) return;
  char version[64];
  std::snprintf(version, sizeof(version), "%sVulkan %u.%u (it is %u.%u)", what,
                VK_API_VERSION_MAJOR(needed), VK_API_VERSION_MINOR(needed),
                VK_API_VERSION_MAJOR(offered), VK_API_VERSION_MINOR(offered));
  gaps->add(version);
}

GapList listGaps(const FeatureSet& needed, const FeatureSet& offered) {
  GapList gaps;
  addVersionGap("", needed.apiVersion, offered.apiVersion, &gaps);
  if (needed.synchronization2 && !offered.synchronization2) gaps.add("synchronization2");
  if (needed.dynamicRendering && !offered.dynamicRendering) gaps.add("dynamicRendering");
  for (const Feature& feature : kFeatures) {
    if (needed.core.*feature.member != VK_FALSE && offered.core.*feature.member == VK_FALSE) {
      gaps.add(feature.name);
    }
  }
  return gaps;
}

Status report(DiagnosticFn diagnostic, void* user, Status status, const char* before,
              const char* name, const char* after, const char* list) {
  char message[2560];
  std::snprintf(message, sizeof(message), "%s%s%s%s.", before, name, after, list);
  if (diagnostic != nullptr) diagnostic(user, {Severity::Error, status, VK_SUCCESS, message});
  return status;
}

/// What the device has; the newer features are asked for only where it knows their struct.
FeatureSet offeredBy(PFN_vkGetPhysicalDeviceFeatures2 getFeatures2, VkPhysicalDevice physicalDevice,
                     uint32_t apiVersion) {
  auto features13 = structure<VkPhysicalDeviceVulkan13Features>(
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES);
  auto features =
      structure<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
  if (apiVersion >= VK_API_VERSION_1_3) features.pNext = &features13;
  getFeatures2(physicalDevice, &features);
  FeatureSet offered;
  offered.apiVersion = apiVersion;
  offered.synchronization2 = features13.synchronization2 != VK_FALSE;
  offered.dynamicRendering = features13.dynamicRendering != VK_FALSE;
  offered.core = features.features;
  return offered;
}

/// Version of the Vulkan loader, or `unknown`: loaders of Vulkan 1.0 don't have the function, nor
/// do hosts' loaders that only resolve the functions of an instance.
uint32_t loaderVersion(PFN_vkGetInstanceProcAddr getInstanceProcAddr, uint32_t unknown) {
  const auto enumerate = reinterpret_cast<PFN_vkEnumerateInstanceVersion>(
      getInstanceProcAddr(VK_NULL_HANDLE, "vkEnumerateInstanceVersion"));
  uint32_t version = 0;
  return enumerate != nullptr && enumerate(&version) == VK_SUCCESS ? version : unknown;
}

}  // namespace

Status checkPhysicalDevice(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance,
                           VkPhysicalDevice physicalDevice, const FeatureSet& needed,
                           DiagnosticFn diagnostic, void* user, FeatureSet* offered) {
  if (offered != nullptr) *offered = {};
  const char* null = nullptr;
  if (physicalDevice == VK_NULL_HANDLE) null = "physicalDevice";
  if (instance == VK_NULL_HANDLE) null = "instance";
  if (getInstanceProcAddr == nullptr) null = "getInstanceProcAddr";
  if (null != nullptr) {
    return report(diagnostic, user, Status::InvalidArgument, "The argument ", null,
                  " of the query is null, but the host's own is expected", "");
  }
  const auto getProperties = reinterpret_cast<PFN_vkGetPhysicalDeviceProperties>(
      getInstanceProcAddr(instance, "vkGetPhysicalDeviceProperties"));
  const auto getFeatures2 = reinterpret_cast<PFN_vkGetPhysicalDeviceFeatures2>(
      getInstanceProcAddr(instance, "vkGetPhysicalDeviceFeatures2"));
  if (getProperties == nullptr || getFeatures2 == nullptr) {
    return report(
        diagnostic, user, Status::Unsupported, "The instance doesn't offer ",
        getProperties == nullptr ? "vkGetPhysicalDeviceProperties" : "vkGetPhysicalDeviceFeatures2",
        ", which Vulkan 1.1 has", "");
  }
  VkPhysicalDeviceProperties properties = {};
  getProperties(physicalDevice, &properties);
  const uint32_t loader = loaderVersion(getInstanceProcAddr, properties.apiVersion);
  const uint32_t version = std::min(loader, properties.apiVersion);
  const FeatureSet found = offeredBy(getFeatures2, physicalDevice, version);
  if (offered != nullptr) *offered = found;
  if (offersAll(found, needed)) return Status::Ok;
  GapList gaps;
  addVersionGap("", needed.apiVersion, properties.apiVersion, &gaps);
  addVersionGap("a loader of ", needed.apiVersion, loader, &gaps);
  FeatureSet features = needed;
  if (!gaps.empty()) features.synchronization2 = features.dynamicRendering = false;
  features.apiVersion = 0;  // Reported already.
  const GapList more = listGaps(features, found);
  if (!more.empty()) gaps.add(more.text());
  return report(diagnostic, user, Status::Unsupported, "The device \"", properties.deviceName,
                "\" lacks what is needed: ", gaps.text());
}

bool offersAll(const FeatureSet& offered, const FeatureSet& needed) {
  return listGaps(needed, offered).empty();
}

Status checkEnabled(const FeatureSet& needed, const FeatureSet& enabled, const char* owner,
                    DiagnosticFn diagnostic, void* user) {
  const GapList gaps = listGaps(needed, enabled);
  if (gaps.empty()) return Status::Ok;
  return report(diagnostic, user, Status::Unsupported, "", owner,
                "::enabled says that the device was made without what is needed: ", gaps.text());
}

void mergeFeatures(const FeatureSet& more, FeatureSet* needed) {
  if (more.apiVersion > needed->apiVersion) needed->apiVersion = more.apiVersion;
  needed->synchronization2 |= more.synchronization2;
  needed->dynamicRendering |= more.dynamicRendering;
  for (const Feature& feature : kFeatures) {
    if (more.core.*feature.member != VK_FALSE) needed->core.*feature.member = VK_TRUE;
  }
}

}  // namespace alpenglow::engine
