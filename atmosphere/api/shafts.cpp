// Light shafts of the public API.
#include <alpenglow/shafts.h>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/shafts/shaft_pass.h"
#include "atmosphere/sky/sky_pass.h"

namespace alpenglow {
inline namespace v1 {

Status createShafts(Context* context, const ShaftsDesc& desc, Shafts** out) {
  if (context == nullptr || out == nullptr) return Status::InvalidArgument;
  *out = nullptr;
  const ShaftsDesc full = shafts::completed(desc);
  Status status = requireCapability(*context, kCapabilityShafts, "createShafts");
  if (status == Status::Ok && full.method == ShaftMethod::Paper)
    status = requireCapability(*context, kCapabilityShadowVolumes, "createShafts of Paper");
  if (status == Status::Ok) status = shafts::checkShaftsDesc(*context->device, full);
  if (status != Status::Ok) return status;
  return Shafts::create(*context->bake, full, out);
}

void destroyShafts(Shafts* shafts) {
  if (shafts != nullptr) Shafts::destroy(shafts, shafts->resources().device().submitting());
}

Status recordSunMap(Shafts* shafts, VkCommandBuffer commands,
                    const double sunDirection[3], const Casters& casters) {
  if (shafts == nullptr || commands == VK_NULL_HANDLE || sunDirection == nullptr)
    return Status::InvalidArgument;
  const engine::Device& device = shafts->resources().device();
  Status status = shafts::checkCasters(device, casters);
  if (status == Status::Ok) status = sky::checkDirection(device, "sunDirection", sunDirection);
  if (status != Status::Ok) return status;
  return shafts->recordSunMap(commands, sunDirection, casters);
}

Status recordShafts(Shafts* shafts, View* view, VkCommandBuffer commands,
                    const Tables* tables, const SkyDraw& draw, const Casters& casters) {
  if (shafts == nullptr || view == nullptr || tables == nullptr || commands == VK_NULL_HANDLE)
    return Status::InvalidArgument;
  const engine::Device& device = shafts->resources().device();
  Status status = view->checkRecord(*tables, draw, "recordShafts");
  if (status == Status::Ok && view->desc().shafts != shafts) {
    status = device.fail(Status::InvalidArgument, VK_SUCCESS,
                         "recordShafts got a view that was made with %s, but needs one whose "
                         "ViewDesc::shafts are these.",
                         view->desc().shafts == nullptr ? "no shafts" : "others");
  }
  if (status == Status::Ok)
    status = sky::checkDepthRange(device, shafts->desc().projection, draw.depth);
  if (status == Status::Ok) status = shafts::checkCasters(device, casters);
  if (status == Status::Ok) status = shafts::checkViewport(device, shafts->desc(), draw);
  if (status != Status::Ok) return status;
  return shafts->record(commands, *tables, draw, casters, view->airSet(*tables, draw));
}

VkDescriptorSetLayout shaftSetLayout(const Shafts* shafts) {
  return shafts == nullptr ? VK_NULL_HANDLE : shafts->setLayout();
}

VkDescriptorSet shaftSet(const Shafts* shafts) {
  return shafts == nullptr ? VK_NULL_HANDLE : shafts->set();
}

}  // namespace v1
}  // namespace alpenglow
