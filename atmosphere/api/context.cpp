#include <cinttypes>
#include <new>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/api/device_desc.h"
#include "atmosphere/parameters/sentence.h"

namespace alpenglow {
inline namespace v1_0 {
namespace {

constexpr CapabilityFlags kDefaultCapabilities = kCapabilityBake | kCapabilitySky;
constexpr CapabilityFlags kAllCapabilities = kDefaultCapabilities | kCapabilityAerialPerspective |
                                             kCapabilityLightShafts | kCapabilityShadowVolumes;
#define ALPENGLOW_CAPABILITY_NAMES                                                             \
  "kCapabilityBake, kCapabilitySky, kCapabilityAerialPerspective, kCapabilityLightShafts and " \
  "kCapabilityShadowVolumes"

const char* capabilityName(CapabilityFlags capability) {
  switch (capability) {
    case kCapabilityBake:
      return "kCapabilityBake";
    case kCapabilitySky:
      return "kCapabilitySky";
    case kCapabilityAerialPerspective:
      return "kCapabilityAerialPerspective";
    case kCapabilityLightShafts:
      return "kCapabilityLightShafts";
    default:
      return "kCapabilityShadowVolumes";
  }
}

// What each capability needs besides what all need.
Requirements requirementsOf(CapabilityFlags wanted) {
  Requirements needed;
  if (wanted == 0) return needed;
  needed.apiVersion = VK_API_VERSION_1_3;
  needed.capabilities = wanted;
  needed.deviceFeatures = kFeatureSynchronization2;
  const bool volumes = (wanted & kCapabilityShadowVolumes) != 0;
  if ((wanted & (kCapabilitySky | kCapabilityLightShafts)) != 0)
    needed.deviceFeatures |= kFeatureDynamicRendering;
  needed.features.dualSrcBlend = (wanted & kCapabilityAerialPerspective) != 0;
  needed.features.depthClamp = (wanted & kCapabilityLightShafts) != 0;
  needed.features.geometryShader = volumes;
  needed.features.shaderClipDistance = volumes;
  needed.features.independentBlend = volumes;
  return needed;
}

/// Those of the wanted capabilities that a device with these features has.
CapabilityFlags capabilitiesOf(const engine::FeatureSet& offered, CapabilityFlags wanted) {
  CapabilityFlags has = 0;
  for (CapabilityFlags one = 1; one <= kAllCapabilities; one <<= 1) {
    const bool asked = (wanted & one) != 0;
    if (asked && engine::offersAll(offered, featureSet(requirementsOf(one)))) has |= one;
  }
  // Shadow volumes are a method of light shafts.
  if ((wanted & ~has & kCapabilityLightShafts) != 0)
    has &= ~CapabilityFlags{kCapabilityShadowVolumes};
  return has;
}

Status checkCapabilities(const ContextDesc& desc) {
  if ((desc.capabilities & ~kAllCapabilities) == 0) return Status::Ok;
  return parameters::report(
      desc.diagnostics, Status::InvalidArgument,
      parameters::Sentence() << "ContextDesc::capabilities is " << desc.capabilities
                             << ", but may have no bits besides " ALPENGLOW_CAPABILITY_NAMES ".");
}

}  // namespace

Status queryRequirements(const ContextDesc& desc, Requirements* out) {
  const DiagnosticSink& sink = desc.diagnostics;
  if (out == nullptr) return parameters::reportNull(sink, "queryRequirements", "the requirements");
  if (Status status = checkCapabilities(desc); status != Status::Ok) return status;
  const CapabilityFlags wanted = desc.capabilities == 0 ? kDefaultCapabilities : desc.capabilities;
  const Requirements needed = requirementsOf(wanted);
  engine::FeatureSet offered;
  const Status status =
      engine::checkPhysicalDevice(desc.getInstanceProcAddr, desc.instance, desc.physicalDevice,
                                  featureSet(needed), sink.report, sink.user, &offered);
  // `out` may be the description's own `enabled`.
  if (status == Status::Ok) *out = needed;
  if (status == Status::Unsupported) *out = requirementsOf(capabilitiesOf(offered, wanted));
  return status;
}

Status createContext(const ContextDesc& desc, Context** out) {
  if (out == nullptr)
    return parameters::reportNull(desc.diagnostics, "createContext", "the context");
  *out = nullptr;
  if (Status status = checkCapabilities(desc); status != Status::Ok) return status;
  auto* context = new (std::nothrow) Context;
  if (context == nullptr) {
    return parameters::report(desc.diagnostics, Status::OutOfHostMemory,
                              "A context found no host memory.");
  }
  context->capabilities = desc.capabilities == 0 ? kDefaultCapabilities : desc.capabilities;
  Requirements needed = requirementsOf(context->capabilities);
  // A host may draw in render passes: createView checks. Light shafts use dynamic rendering.
  if ((context->capabilities & kCapabilityLightShafts) == 0)
    needed.deviceFeatures &= ~DeviceFeatureFlags{kFeatureDynamicRendering};
  Status status = createDevice(desc, needed, &context->device);
  if (status == Status::Ok)
    status = tables::Resources::create(*context->device, desc.setStages, &context->bake);
  if (status == Status::Ok) context->bake->context = context;
  if (status == Status::Ok && (context->capabilities & kCapabilityBake) != 0)
    status = passes::ProbePass::create(*context->bake, &context->probe);
  if (status != Status::Ok) {
    destroyContext(context);
    return status;
  }
  *out = context;
  return Status::Ok;
}

void destroyContext(Context* context) {
  if (context == nullptr) return;
  if (context->device != nullptr) context->device->frames().destroyAll();
  passes::ProbePass::destroy(context->probe);
  tables::Resources::destroy(context->bake);
  engine::Device::destroy(context->device);
  delete context;
}

Status advanceFrame(Context* context, uint64_t submitting, uint64_t completed) {
  if (context == nullptr) return Status::InvalidArgument;
  engine::Device& device = *context->device;
  const uint64_t submittingBefore = device.submitting(), completedBefore = device.completed();
  if (submitting == 0 || completed > submitting || submitting < submittingBefore ||
      completed < completedBefore) {
    const char* rule = submitting == 0          ? "the frame being recorded counts from 1"
                       : completed > submitting ? "no frame completes before it is recorded"
                                                : "neither number falls";
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "advanceFrame got submitting %" PRIu64 " and completed %" PRIu64
                       " after %" PRIu64 " and %" PRIu64 ", but %s.",
                       submitting, completed, submittingBefore, completedBefore, rule);
  }
  device.frames().advance(submitting, completed);
  device.deletions().collect(completed);
  return Status::Ok;
}

Status abandonFrame(Context* context, uint64_t frame) {
  if (context == nullptr) return Status::InvalidArgument;
  engine::Device& device = *context->device;
  if (frame <= device.completed() || frame > device.submitting()) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "abandonFrame got frame %" PRIu64
                       ", but needs one above the completed %" PRIu64
                       " and not above the one being recorded, %" PRIu64 ".",
                       frame, device.completed(), device.submitting());
  }
  device.frames().abandon(frame);
  return Status::Ok;
}

void resourceReport(const Context* context, ResourceReport* out) {
  if (context != nullptr && out != nullptr) *out = resourceReportOf(context->device->counters());
}

Status requireCapability(const Context& context, CapabilityFlags capability, const char* call) {
  if ((context.capabilities & capability) != 0) return Status::Ok;
  return context.device->fail(Status::Unsupported, VK_SUCCESS,
                              "%s needs a context with %s, but this one was made without it.", call,
                              capabilityName(capability));
}

}  // namespace v1_0
}  // namespace alpenglow
