// Views of the public API.
#include <alpenglow/view.h>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/sky/sky_pass.h"

namespace alpenglow {
inline namespace v1 {

Status createView(Context* context, const ViewDesc& desc, View** out) {
  if (context == nullptr || out == nullptr) return Status::InvalidArgument;
  *out = nullptr;
  Status status = requireCapability(*context, kCapabilitySky, "createView");
  if (status == Status::Ok) status = sky::checkViewDesc(*context->device, desc);
  if (status != Status::Ok) return status;
  return View::create(*context->bake, desc, out);
}

void destroyView(View* view, const FrameInfo& frame) { View::destroy(view, frame); }

Status recordSkySlice(View* view, VkCommandBuffer commands, const FrameInfo& frame,
                      const Tables* tables, const SkyDraw& draw) {
  if (view == nullptr || tables == nullptr || commands == VK_NULL_HANDLE)
    return Status::InvalidArgument;
  view->collect(frame);
  return view->recordSlice(commands, *tables, draw);
}

Status recordSky(View* view, VkCommandBuffer commands, const FrameInfo& frame, const Tables* tables,
                 const SkyDraw& draw) {
  if (view == nullptr || tables == nullptr || commands == VK_NULL_HANDLE)
    return Status::InvalidArgument;
  view->collect(frame);
  return view->recordSky(commands, *tables, draw);
}

}  // namespace v1
}  // namespace alpenglow
