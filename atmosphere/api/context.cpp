#include <new>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/api/device_desc.h"

namespace alpenglow {
inline namespace v1 {
namespace {

constexpr CapabilityFlags kDefaultCapabilities = kCapabilityBake | kCapabilitySky;
constexpr CapabilityFlags kAllCapabilities =
    kDefaultCapabilities | kCapabilityAir | kCapabilityShafts | kCapabilityShadowVolumes;
#define ALPENGLOW_CAPABILITY_NAMES                                          \
  "kCapabilityBake, kCapabilitySky, kCapabilityAir, kCapabilityShafts and " \
  "kCapabilityShadowVolumes"

const char* capabilityName(CapabilityFlags capability) {
  switch (capability) {
    case kCapabilityBake:
      return "kCapabilityBake";
    case kCapabilitySky:
      return "kCapabilitySky";
    case kCapabilityAir:
      return "kCapabilityAir";
    case kCapabilityShafts:
      return "kCapabilityShafts";
    default:
      return "kCapabilityShadowVolumes";
  }
}

// Each capability asks for what it alone needs.
Requirements requirementsOf(CapabilityFlags wanted) {
  Requirements needed;
  needed.apiVersion = VK_API_VERSION_1_3;
  needed.synchronization2 = true;
  const bool volumes = (wanted & kCapabilityShadowVolumes) != 0;
  needed.dynamicRendering = (wanted & (kCapabilitySky | kCapabilityShafts)) != 0;
  needed.features.dualSrcBlend = (wanted & kCapabilityAir) != 0;
  needed.features.depthClamp = (wanted & kCapabilityShafts) != 0;
  needed.features.geometryShader = volumes;
  needed.features.shaderClipDistance = volumes;
  needed.features.independentBlend = volumes;
  return needed;
}

Status reportTo(DiagnosticFn diagnostic, void* user, Status status, const char* message) {
  if (diagnostic != nullptr) diagnostic(user, {Severity::Error, status, VK_SUCCESS, message});
  return status;
}

}  // namespace

Status queryRequirements(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance,
                         VkPhysicalDevice physicalDevice, CapabilityFlags wanted, Requirements* out,
                         DiagnosticFn diagnostic, void* user) {
  if (out == nullptr || (wanted & ~kAllCapabilities) != 0) {
    return reportTo(diagnostic, user, Status::InvalidArgument,
                    "queryRequirements needs a place for its answer and capabilities "
                    "among " ALPENGLOW_CAPABILITY_NAMES ".");
  }
  *out = requirementsOf(wanted == 0 ? kDefaultCapabilities : wanted);
  return engine::checkPhysicalDevice(getInstanceProcAddr, instance, physicalDevice,
                                     featureSet(*out), diagnostic, user);
}

Status createContext(const ContextDesc& desc, Context** out) {
  if (out == nullptr) {
    return reportTo(desc.diagnostic, desc.user, Status::InvalidArgument,
                    "createContext needs a place for the context, but got null.");
  }
  *out = nullptr;
  if ((desc.capabilities & ~kAllCapabilities) != 0) {
    return reportTo(
        desc.diagnostic, desc.user, Status::InvalidArgument,
        "ContextDesc::capabilities has unknown bits, but only " ALPENGLOW_CAPABILITY_NAMES
        " exist.");
  }
  auto* context = new (std::nothrow) Context;
  if (context == nullptr) {
    return reportTo(desc.diagnostic, desc.user, Status::OutOfHostMemory,
                    "A context found no host memory.");
  }
  context->capabilities = desc.capabilities == 0 ? kDefaultCapabilities : desc.capabilities;
  Requirements needed = requirementsOf(context->capabilities);
  // A host may draw in render passes: createView asks. Shafts have scopes of their own.
  needed.dynamicRendering = (context->capabilities & kCapabilityShafts) != 0;
  Status status = createDevice(desc, needed, &context->device);
  if (status == Status::Ok) status = bake::Resources::create(*context->device, &context->bake);
  if (status == Status::Ok) context->bake->context = context;
  if (status == Status::Ok && (context->capabilities & kCapabilityBake) != 0)
    status = sky::ProbePass::create(*context->bake, &context->probe);
  if (status != Status::Ok) {
    destroyContext(context);
    return status;
  }
  *out = context;
  return Status::Ok;
}

void destroyContext(Context* context) {
  if (context == nullptr) return;
  if (context->bake != nullptr) {
    const uint32_t tables = context->bake->liveTables, views = context->bake->liveViews;
    if (tables != 0 || views != 0) {
      context->device->notice(Severity::Warning,
                              "The context is destroyed before %u Tables and %u View objects of "
                              "it, but must be the last: what they hold is lost.",
                              tables, views);
    }
  }
  sky::ProbePass::destroy(context->probe);
  bake::Resources::destroy(context->bake);
  engine::Device::destroy(context->device);
  delete context;
}

void collect(Context* context, uint64_t completed) {
  if (context != nullptr) context->device->deletions().collect(completed);
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

}  // namespace v1
}  // namespace alpenglow
