// Whether a frame shows an effect that its view has disabled.
#include "atmosphere/passes/sky_pass.h"

namespace alpenglow::passes {

Status checkDrawnEffects(const engine::Device& device, const Parameters& parameters,
                         const PictureDesc& desc, const FrameState& draw) {
  const double altitude = cameraAltitude(parameters, draw.camera);
  const double top = parameters.topRadius_m - parameters.bottomRadius_m;
  if (hasEffect(desc.disabledEffects, Effect::SpaceViews) || altitude <= top) return Status::Ok;
  return device.fail(Status::InvalidArgument, VK_SUCCESS,
                     "The camera is %g m high, above the top of the atmosphere at %g m, but "
                     "ViewDesc::disabledEffects has Effect::SpaceViews: make a view with it.",
                     altitude, top);
}

Status checkPartition(const engine::Device& device, const PictureDesc& desc,
                      const ViewportPartition& parts) {
  for (uint32_t i = 0; i < parts.count; ++i) {
    const Visible& seen = parts.parts[i].visible;
    const char* missing = drawn(desc.disabledEffects, seen) ? nullptr
                          : seen.ground && !hasEffect(desc.disabledEffects, Effect::Ground)
                              ? "the ground, but ViewDesc::disabledEffects has Effect::Ground"
                          : seen.disc && !hasEffect(desc.disabledEffects, Effect::SunDisc)
                              ? "the sun's disc, but ViewDesc::disabledEffects has Effect::SunDisc"
                              : "space, but ViewDesc::disabledEffects has Effect::SpaceViews";
    if (missing == nullptr) continue;
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "The draw may see %s: make a view with it.", missing);
  }
  return Status::Ok;
}

}  // namespace alpenglow::passes
