// Views of the public API: argument checks, then atmosphere/view.
#include <alpenglow/view.h>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/view/view.h"

namespace alpenglow {
inline namespace v1_0 {
namespace {

Status nullCall(const View* view, const char* call) {
  if (view == nullptr) return Status::InvalidArgument;
  return view->resources().device().fail(Status::InvalidArgument, VK_SUCCESS,
                                         "%s got a null argument, but needs all of them.", call);
}

/// Checks each capability that the description needs.
Status requireCapabilities(const Context& context, const ViewDesc& desc) {
  Status status = requireCapability(context, kCapabilitySky, "createView");
  if (status == Status::Ok && desc.aerialPerspective != AerialPerspective::Off) {
    status = requireCapability(context, kCapabilityAerialPerspective,
                               "createView with ViewDesc::aerialPerspective");
  }
  if (status == Status::Ok && desc.lightShafts.method != LightShaftMethod::Off)
    status =
        requireCapability(context, kCapabilityLightShafts, "createView with ViewDesc::lightShafts");
  if (status == Status::Ok && desc.lightShafts.method == LightShaftMethod::ShadowVolume) {
    status = requireCapability(context, kCapabilityShadowVolumes,
                               "createView with LightShaftMethod::ShadowVolume");
  }
  return status;
}

}  // namespace

Status createView(Context* context, const Tables* tables, const ViewDesc& desc, View** out) {
  if (out != nullptr) *out = nullptr;
  if (context == nullptr || tables == nullptr || out == nullptr)
    return nullArgument(context, "createView");
  if (&tables->resources() != context->bake) {
    return context->device->fail(
        Status::InvalidArgument, VK_SUCCESS,
        "createView got tables of another context, but needs tables of its "
        "own.");
  }
  Status status = requireCapabilities(*context, desc);
  if (status == Status::Ok) status = view::checkViewDesc(*context->device, tables->desc(), desc);
  return status == Status::Ok ? View::create(*context->bake, *tables, desc, out) : status;
}

void destroyView(View* view) {
  if (view != nullptr) View::destroy(view, view->resources().device().submitting());
}

Status beginFrame(View* view, const FrameDesc& desc, FrameWork* work) {
  return view == nullptr ? Status::InvalidArgument : view->beginFrame(desc, work);
}

Status recordLuts(View* view, VkCommandBuffer commands) {
  if (view == nullptr || commands == VK_NULL_HANDLE) return nullCall(view, "recordLuts");
  return view->recordLuts(commands);
}

Status recordShadowMap(View* view, VkCommandBuffer commands) {
  if (view == nullptr || commands == VK_NULL_HANDLE) return nullCall(view, "recordShadowMap");
  return view->recordShadowMap(commands);
}

Status recordLightShafts(View* view, VkCommandBuffer commands) {
  if (view == nullptr || commands == VK_NULL_HANDLE) return nullCall(view, "recordLightShafts");
  return view->recordLightShafts(commands);
}

Status recordAerialPerspective(View* view, VkCommandBuffer commands) {
  if (view == nullptr || commands == VK_NULL_HANDLE)
    return nullCall(view, "recordAerialPerspective");
  return view->recordAerialPerspective(commands);
}

Status recordSky(View* view, VkCommandBuffer commands) {
  if (view == nullptr || commands == VK_NULL_HANDLE) return nullCall(view, "recordSky");
  return view->recordSky(commands);
}

Status viewInfo(const View* view, ViewInfo* out) {
  if (view == nullptr || out == nullptr) return nullCall(view, "viewInfo");
  view->info(out);
  return Status::Ok;
}

}  // namespace v1_0
}  // namespace alpenglow
