// Views of the public API.
#include <alpenglow/view.h>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/model/sentence.h"
#include "atmosphere/model/solvers.h"
#include "atmosphere/shafts/shaft_pass.h"
#include "atmosphere/sky/sky_pass.h"

namespace alpenglow {
inline namespace v1 {
namespace {

/// Shadows of another picture would be read as this one's.
Status checkShafts(const Context& context, const ViewDesc& desc) {
  if (desc.shafts == nullptr) return Status::Ok;
  const ShaftsDesc& shafts = desc.shafts->desc();
  const SceneDepth &a = shafts.sceneDepth, &b = desc.sceneDepth;
  const bool same = a.view == b.view && a.format == b.format && a.layout == b.layout &&
                    a.extent.width == b.extent.width && a.extent.height == b.extent.height &&
                    shafts.depth == desc.depth && shafts.projection == desc.projection &&
                    shafts.without == desc.without;
  if (same && desc.solver == Solver::Moments && &desc.shafts->resources() == context.bake)
    return Status::Ok;
  model::Sentence why;
  if (desc.solver != Solver::Moments) {
    why << "are for a view of Solver::" << solverEnumerator(desc.solver);
  } else {
    why << (&desc.shafts->resources() != context.bake ? "are of another context"
                                                      : "were made for another picture");
  }
  return context.device->fail(
      Status::InvalidArgument, VK_SUCCESS,
      "ViewDesc::shafts %s, but a view needs shafts of its own context, made for its sceneDepth, "
      "depth, projection and without, and Solver::Moments.",
      why.text());
}

/// What the sky room may know of them.
sky::ShaftSet shaftSetOf(const Shafts* shafts) {
  if (shafts == nullptr) return {};
  const ShaftsDesc& desc = shafts->desc();
  return {shafts->setLayout(), shafts->set(), static_cast<uint32_t>(desc.method), desc.samples,
          static_cast<float>(desc.multipleLoss)};
}

/// Ok, or a sentence when a view would draw with another frame's shadows.
Status checkRecorded(const View& view, const Tables& tables, const SkyDraw& draw) {
  const Shafts* shafts = view.desc().shafts;
  if (shafts == nullptr || shafts->serves(tables, draw)) return Status::Ok;
  return view.resources().device().fail(
      Status::InvalidArgument, VK_SUCCESS,
      "The view draws light shafts, but recordShafts was not called last for this draw's tables, "
      "camera, sun and viewport.");
}

}  // namespace

Status createView(Context* context, const ViewDesc& desc, View** out) {
  if (context == nullptr || out == nullptr) return Status::InvalidArgument;
  *out = nullptr;
  Status status = requireCapability(*context, kCapabilitySky, "createView");
  if (status == Status::Ok) status = sky::checkViewDesc(*context->device, desc);
  if (status == Status::Ok && desc.sceneDepth.view != VK_NULL_HANDLE)
    status = requireCapability(*context, kCapabilityAir, "createView with ViewDesc::sceneDepth");
  if (status == Status::Ok) status = checkShafts(*context, desc);
  if (status != Status::Ok) return status;
  return View::create(*context->bake, desc, shaftSetOf(desc.shafts), out);
}

void destroyView(View* view) {
  if (view != nullptr) View::destroy(view, view->resources().device().submitting());
}

Status recordSkySlice(View* view, VkCommandBuffer commands,
                      const Tables* tables, const SkyDraw& draw) {
  if (view == nullptr || tables == nullptr || commands == VK_NULL_HANDLE)
    return Status::InvalidArgument;
  return view->recordSlice(commands, *tables, draw);
}

Status recordSky(View* view, VkCommandBuffer commands, const Tables* tables,
                 const SkyDraw& draw) {
  if (view == nullptr || tables == nullptr || commands == VK_NULL_HANDLE)
    return Status::InvalidArgument;
  Status status = view->checkRecord(*tables, draw, "recordSky");
  if (status == Status::Ok) status = checkRecorded(*view, *tables, draw);
  return status == Status::Ok ? view->recordSky(commands, *tables, draw) : status;
}

Status recordAir(View* view, VkCommandBuffer commands, const Tables* tables,
                 const SkyDraw& draw) {
  if (view == nullptr || tables == nullptr || commands == VK_NULL_HANDLE)
    return Status::InvalidArgument;
  Status status = view->checkRecord(*tables, draw, "recordAir");
  if (status == Status::Ok) status = checkRecorded(*view, *tables, draw);
  return status == Status::Ok ? view->recordAir(commands, *tables, draw) : status;
}

}  // namespace v1
}  // namespace alpenglow
