#include "atmosphere/api/device_desc.h"

namespace alpenglow {
inline namespace v1_0 {

engine::FeatureSet featureSet(const Requirements& requirements) {
  engine::FeatureSet set;
  set.apiVersion = requirements.apiVersion;
  set.synchronization2 = (requirements.deviceFeatures & kFeatureSynchronization2) != 0;
  set.dynamicRendering = (requirements.deviceFeatures & kFeatureDynamicRendering) != 0;
  set.core = requirements.features;
  return set;
}

Status createDevice(const ContextDesc& desc, const Requirements& needed, engine::Device** out) {
  const engine::ShaderReplacement shaders = {desc.shaders.user, desc.shaders.replace};
  const MemoryHooks& memory = desc.memory;
  engine::DeviceDesc device;
  device.name = "ContextDesc";
  device.instance = desc.instance;
  device.physicalDevice = desc.physicalDevice;
  device.device = desc.device;
  device.getInstanceProcAddr = desc.getInstanceProcAddr;
  device.needed = featureSet(needed);
  device.enabled = featureSet(desc.enabled);
  device.queueFamilies = desc.queueFamilies;
  device.queueFamilyCount = desc.queueFamilyCount;
  device.pipelineCache = desc.pipelineCache;
  device.allocator = desc.allocator;
  if (memory.allocate != nullptr || memory.free != nullptr) device.memory = &memory;
  device.shaders = &shaders;
  device.diagnostic = desc.diagnostics.report;
  device.user = desc.diagnostics.user;
  device.debugNames = desc.debugNames;
  return engine::Device::create(device, out);
}

ResourceReport resourceReportOf(const engine::Counters& counters) {
  ResourceReport report;
  report.pipelines = counters.pipelines;
  report.shaderVariants = counters.shaderVariants;
  report.images = counters.images;
  report.buffers = counters.buffers;
  report.bytes = counters.bytes;
  report.peakBytes = counters.peakBytes;
  report.dispatches = counters.dispatches;
  report.draws = counters.draws;
  report.lutUpdates = counters.lutUpdates;
  report.lutsSkipped = counters.lutsSkipped;
  report.shadowMapUpdates = counters.shadowMapUpdates;
  report.shadowMapsSkipped = counters.shadowMapsSkipped;
  return report;
}

}  // namespace v1_0
}  // namespace alpenglow
