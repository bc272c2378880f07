// What a host may ask of a view.
#include <bit>

#include "atmosphere/sky/sky_pass.h"

namespace alpenglow::sky {

namespace {

Status checkSceneDepth(const engine::Device& device, const ViewDesc& desc) {
  const SceneDepth& scene = desc.sceneDepth;
  if (scene.view == VK_NULL_HANDLE) return Status::Ok;
  if (scene.extent.width == 0 || scene.extent.height == 0 ||
      desc.samples != VK_SAMPLE_COUNT_1_BIT || desc.projection == Projection::Fisheye) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ViewDesc::sceneDepth has %u x %u pixels, for a view of %u samples and "
                       "projection %u, but needs its size, one sample and no fisheye.",
                       scene.extent.width, scene.extent.height, static_cast<uint32_t>(desc.samples),
                       static_cast<uint32_t>(desc.projection));
  }
  if ((device.formatProperties(desc.colorFormat).optimalTilingFeatures &
       VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) == 0) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "ViewDesc::colorFormat is VkFormat %d, which this device can't blend, but "
                       "aerial perspective is blended over ViewDesc::sceneDepth's picture.",
                       static_cast<int>(desc.colorFormat));
  }
  return Status::Ok;
}

Status checkEffects(const engine::Device& device, const ViewDesc& desc) {
  const EffectFlags known =
      kViewEffects | (desc.solver == Solver::Moments ? kTableEffects : EffectFlags{0});
  if ((desc.without & ~known) != 0) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ViewDesc::without is 0x%x, but may have bits of kViewEffects and, for "
                       "Solver::Moments, kTableEffects alone: 0x%x.",
                       desc.without, known);
  }
  const bool parallel = desc.projection == Projection::Orthographic;
  if (parallel && !hasEffect(desc.without, Effect::SpaceViews)) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ViewDesc is without Effect::SpaceViews, but the rays of its orthographic "
                       "camera may begin anywhere.");
  }
  if (desc.alwaysSliced && (desc.skySlice == nullptr || parallel)) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ViewDesc::alwaysSliced was given with %s, but needs a perspective or "
                       "fisheye view with ViewDesc::skySlice.",
                       parallel ? "an orthographic projection" : "no skySlice");
  }
  return Status::Ok;
}

}  // namespace

Status checkDrawnEffects(const engine::Device& device, const Parameters& parameters,
                         const ViewDesc& desc, const SkyDraw& draw) {
  const double altitude = cameraAltitude(parameters, draw.camera);
  const double top = parameters.topRadius_m - parameters.bottomRadius_m;
  if (hasEffect(desc.without, Effect::SpaceViews) || altitude <= top) return Status::Ok;
  return device.fail(Status::InvalidArgument, VK_SUCCESS,
                     "The camera is %g m high, above the top of the air at %g m, but "
                     "ViewDesc::without has Effect::SpaceViews: make a view with it.",
                     altitude, top);
}

Status checkParts(const engine::Device& device, const ViewDesc& desc, const Parts& parts) {
  for (uint32_t i = 0; i < parts.count; ++i) {
    const Visible& seen = parts.parts[i].visible;
    const char* missing = drawn(desc.without, seen) ? nullptr
                          : seen.ground && !hasEffect(desc.without, Effect::Ground)
                              ? "the ground, but ViewDesc::without has Effect::Ground"
                          : seen.disc && !hasEffect(desc.without, Effect::SunDisc)
                              ? "the sun's disc, but ViewDesc::without has Effect::SunDisc"
                              : "space, but ViewDesc::without has Effect::SpaceViews";
    if (missing == nullptr) continue;
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "The draw may see %s: make a view with it.", missing);
  }
  return Status::Ok;
}

Status checkViewDesc(const engine::Device& device, const ViewDesc& desc) {
  const VkFormatFeatureFlags features =
      device.formatProperties(desc.colorFormat).optimalTilingFeatures;
  if (desc.colorFormat == VK_FORMAT_UNDEFINED ||
      (features & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) == 0) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "ViewDesc::colorFormat is VkFormat %d, but must be one that this device can "
                       "render to.",
                       static_cast<int>(desc.colorFormat));
  }
  const bool depth = desc.depthFormat != VK_FORMAT_UNDEFINED;
  if (depth && (device.formatProperties(desc.depthFormat).optimalTilingFeatures &
                VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) == 0) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "ViewDesc::depthFormat is VkFormat %d, but must be a depth format of this "
                       "device, or VK_FORMAT_UNDEFINED for none.",
                       static_cast<int>(desc.depthFormat));
  }
  const VkPhysicalDeviceLimits& limits = device.limits();
  const VkSampleCountFlags counts =
      limits.framebufferColorSampleCounts &
      (depth ? limits.framebufferDepthSampleCounts : ~VkSampleCountFlags{0});
  if ((counts & desc.samples) == 0 || !std::has_single_bit(static_cast<uint32_t>(desc.samples))) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "ViewDesc::samples is %u, but must be one of this device's sample counts, "
                       "the bits of 0x%x.",
                       static_cast<uint32_t>(desc.samples), counts);
  }
  if (desc.viewMask != 0) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "ViewDesc::viewMask is 0x%x, but must be 0: this version draws one view "
                       "at a time.",
                       desc.viewMask);
  }
  if (desc.projection > Projection::Orthographic || desc.depth > DepthConvention::Reversed ||
      desc.mie > MieStorage::Packed || desc.solver > Solver::Hillaire) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ViewDesc has projection %u, depth %u, mie %u and solver %u, but the "
                       "greatest are 2, 1, 1 and 5.",
                       static_cast<uint32_t>(desc.projection), static_cast<uint32_t>(desc.depth),
                       static_cast<uint32_t>(desc.mie), static_cast<uint32_t>(desc.solver));
  }
  if (desc.groundAlbedo.view != VK_NULL_HANDLE &&
      (desc.groundAlbedo.sampler == VK_NULL_HANDLE || desc.groundAlbedo.height == 0)) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ViewDesc::groundAlbedo has a view with %s sampler and height %u, but "
                       "needs a sampler and the image's size.",
                       desc.groundAlbedo.sampler == VK_NULL_HANDLE ? "no" : "a",
                       desc.groundAlbedo.height);
  }
  const Status status = checkEffects(device, desc);
  return status == Status::Ok ? checkSceneDepth(device, desc) : status;
}

}  // namespace alpenglow::sky
