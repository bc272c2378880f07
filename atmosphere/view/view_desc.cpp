#include "atmosphere/view/view_desc.h"

#include <bit>

#include "atmosphere/parameters/solvers.h"
#include "atmosphere/passes/light_shaft_pass.h"

namespace alpenglow::view {
namespace {

constexpr VkPipelineStageFlags2 kDefaultReaders =
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;

Status later(const engine::Device& device, const char* member) {
  return device.fail(Status::Unsupported, VK_SUCCESS,
                     "ViewDesc::%s is given, but must be 0 in this version.", member);
}

Status checkLater(const engine::Device& device, const ViewDesc& desc) {
  const struct {
    const char* member;
    bool given;
  } members[] = {
      {"viewMask", desc.viewMask != 0},
      {"color", desc.color != ColorSpace::Rec709},
      {"skyLightDegree", desc.skyLightDegree != 0},
      {"environmentSize", desc.environmentSize != 0},
      {"environmentLevels", desc.environmentLevels != 0},
      {"environmentFlags", desc.environmentFlags != 0},
      {"lutTolerance", desc.lutTolerance != 0.0},
      {"lutFrames", desc.lutFrames > 1},
      {"aerialPerspective as LutOnly", desc.aerialPerspective == AerialPerspective::LutOnly}};
  for (const auto& entry : members)
    if (entry.given) return later(device, entry.member);
  return Status::Ok;
}

Status checkEnumerations(const engine::Device& device, const ViewDesc& desc) {
  if (desc.projection <= Projection::Orthographic && desc.depth <= DepthConvention::Reversed &&
      desc.sky <= SkyMethod::Integrate && desc.aerialPerspective <= AerialPerspective::Integrate)
    return Status::Ok;
  return device.fail(Status::InvalidArgument, VK_SUCCESS,
                     "ViewDesc has projection %u, depth %u, sky %u and aerialPerspective %u, but "
                     "these enumerations end at 2, 1, 1 and 3.",
                     static_cast<uint32_t>(desc.projection), static_cast<uint32_t>(desc.depth),
                     static_cast<uint32_t>(desc.sky),
                     static_cast<uint32_t>(desc.aerialPerspective));
}

/// Whether colour attachments of the format hold floating-point or normalised numbers.
bool holdsColor(VkFormat format) {
  // The core formats' numeric types repeat; integers are those that a float blend can't write.
  switch (format) {
    case VK_FORMAT_R8_UINT:
    case VK_FORMAT_R8_SINT:
    case VK_FORMAT_R8G8_UINT:
    case VK_FORMAT_R8G8_SINT:
    case VK_FORMAT_R8G8B8A8_UINT:
    case VK_FORMAT_R8G8B8A8_SINT:
    case VK_FORMAT_B8G8R8A8_UINT:
    case VK_FORMAT_B8G8R8A8_SINT:
    case VK_FORMAT_A8B8G8R8_UINT_PACK32:
    case VK_FORMAT_A8B8G8R8_SINT_PACK32:
    case VK_FORMAT_A2R10G10B10_UINT_PACK32:
    case VK_FORMAT_A2R10G10B10_SINT_PACK32:
    case VK_FORMAT_A2B10G10R10_UINT_PACK32:
    case VK_FORMAT_A2B10G10R10_SINT_PACK32:
    case VK_FORMAT_R16_UINT:
    case VK_FORMAT_R16_SINT:
    case VK_FORMAT_R16G16_UINT:
    case VK_FORMAT_R16G16_SINT:
    case VK_FORMAT_R16G16B16A16_UINT:
    case VK_FORMAT_R16G16B16A16_SINT:
    case VK_FORMAT_R32_UINT:
    case VK_FORMAT_R32_SINT:
    case VK_FORMAT_R32G32_UINT:
    case VK_FORMAT_R32G32_SINT:
    case VK_FORMAT_R32G32B32A32_UINT:
    case VK_FORMAT_R32G32B32A32_SINT:
      return false;
    default:
      return true;
  }
}

Status checkTarget(const engine::Device& device, const ViewDesc& desc, uint32_t samples) {
  const VkFormatFeatureFlags features =
      device.formatProperties(desc.colorFormat).optimalTilingFeatures;
  if (desc.colorFormat == VK_FORMAT_UNDEFINED || !holdsColor(desc.colorFormat) ||
      (features & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) == 0) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "ViewDesc::colorFormat is VkFormat %d, but must be one that this device can "
                       "render colours to.",
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
  if ((counts & samples) == 0 || !std::has_single_bit(samples)) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "ViewDesc::samples is %u, but must be one of this device's sample counts, "
                       "the bits of 0x%x.",
                       samples, counts);
  }
  if (desc.groundAlbedo.view != VK_NULL_HANDLE &&
      (desc.groundAlbedo.sampler == VK_NULL_HANDLE || desc.groundAlbedo.extent.height == 0)) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ViewDesc::groundAlbedo has a view with %s sampler and height %u, but "
                       "needs a sampler and the image's extent.",
                       desc.groundAlbedo.sampler == VK_NULL_HANDLE ? "no" : "a",
                       desc.groundAlbedo.extent.height);
  }
  return Status::Ok;
}

Status checkEffects(const engine::Device& device, const TableDesc& tables, const ViewDesc& desc) {
  const EffectFlags known = kViewEffects | (tables.disabledEffects & kTableEffects);
  if ((desc.disabledEffects & ~known) != 0) {
    return device.fail(
        Status::InvalidArgument, VK_SUCCESS,
        "ViewDesc::disabledEffects is 0x%x, but may have bits of kViewEffects and of "
        "the effects that the tables lack alone: 0x%x.",
        desc.disabledEffects, known);
  }
  if (desc.projection == Projection::Orthographic &&
      !hasEffect(desc.disabledEffects, Effect::SpaceViews)) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ViewDesc::disabledEffects has Effect::SpaceViews, but the rays of an "
                       "orthographic camera may begin anywhere.");
  }
  return Status::Ok;
}

Status checkAerial(const engine::Device& device, const ResolvedView& view, uint32_t samples) {
  const PictureDesc& desc = view.picture;
  if (!desc.aerial) {
    if (!view.hasLightShafts) return Status::Ok;
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ViewDesc::lightShafts has a method, but light shafts need "
                       "ViewDesc::aerialPerspective.");
  }
  if (samples != 1 || desc.projection == Projection::Fisheye ||
      desc.sceneDepthFormat == VK_FORMAT_UNDEFINED) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ViewDesc::aerialPerspective was given with %u samples, projection %u and "
                       "the scene's depth as VkFormat %d, but needs one sample, no fisheye and a "
                       "depth format.",
                       samples, static_cast<uint32_t>(desc.projection),
                       static_cast<int>(desc.sceneDepthFormat));
  }
  constexpr VkFormatFeatureFlags kDepth =
      VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT;
  if ((device.formatProperties(desc.sceneDepthFormat).optimalTilingFeatures & kDepth) != kDepth) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "ViewDesc::sceneDepthFormat is VkFormat %d, but aerial perspective needs a "
                       "depth format that this device can sample.",
                       static_cast<int>(desc.sceneDepthFormat));
  }
  if ((device.formatProperties(desc.colorFormat).optimalTilingFeatures &
       VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BLEND_BIT) == 0) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "ViewDesc::colorFormat is VkFormat %d, which this device can't blend, but "
                       "aerial perspective is blended over the host's picture.",
                       static_cast<int>(desc.colorFormat));
  }
  if (!view.hasLightShafts) return Status::Ok;
  if (desc.solver != Solver::Moments) {
    return device.fail(
        Status::InvalidArgument, VK_SUCCESS,
        "ViewDesc::lightShafts has a method, but the tables are of Solver::%s: light "
        "shafts need Solver::Moments.",
        solverEnumerator(desc.solver));
  }
  return passes::checkLightShaftSettings(device, view.shafts);
}

}  // namespace

ResolvedView resolve(const TableDesc& tables, const ViewDesc& desc) {
  ResolvedView out;
  PictureDesc& p = out.picture;
  p.colorFormat = desc.colorFormat;
  p.depthFormat = desc.depthFormat;
  p.sceneDepthFormat =
      desc.sceneDepthFormat != VK_FORMAT_UNDEFINED ? desc.sceneDepthFormat : desc.depthFormat;
  p.depth = desc.depth;
  p.samples = static_cast<VkSampleCountFlagBits>(desc.samples == 0 ? 1 : desc.samples);
  p.renderPass = desc.renderPass;
  p.subpass = desc.subpass;
  p.projection = desc.projection;
  p.solver = tables.solver;
  p.mie = tables.mie;
  p.groundAlbedo = desc.groundAlbedo;
  if (p.groundAlbedo.layout == VK_IMAGE_LAYOUT_UNDEFINED)
    p.groundAlbedo.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  p.disabledEffects = desc.disabledEffects | tables.disabledEffects;
  const bool parallel = desc.projection == Projection::Orthographic;
  p.skyLut = desc.sky == SkyMethod::Lut && !parallel && hasSkyViewLut(tables.solver);
  // The others have no LUT above the top of the atmosphere.
  p.onlyLut = p.skyLut && (tables.solver == Solver::Moments ||
                           !hasEffect(p.disabledEffects, Effect::SpaceViews));
  p.aerial = desc.aerialPerspective != AerialPerspective::Off;
  p.aerialLut = desc.aerialPerspective == AerialPerspective::On && !parallel &&
                tables.solver == Solver::Moments;
  out.hasLightShafts = desc.lightShafts.method != LightShaftMethod::Off;
  static_cast<LightShaftDesc&>(out.shafts) = desc.lightShafts;
  out.shafts.sceneDepthFormat = p.sceneDepthFormat;
  out.shafts.depth = p.depth;
  out.shafts.projection = p.projection;
  out.shafts.disabledEffects = p.disabledEffects;
  out.shafts = passes::completed(out.shafts);
  out.readers = desc.readerStages != 0 ? desc.readerStages : kDefaultReaders;
  return out;
}

Status checkViewDesc(const engine::Device& device, const TableDesc& tables, const ViewDesc& desc) {
  Status status = checkEnumerations(device, desc);
  if (status == Status::Ok) status = checkLater(device, desc);
  if (status != Status::Ok) return status;
  const uint32_t samples = desc.samples == 0 ? 1 : desc.samples;
  status = checkTarget(device, desc, samples);
  if (status == Status::Ok) status = checkEffects(device, tables, desc);
  return status == Status::Ok ? checkAerial(device, resolve(tables, desc), samples) : status;
}

}  // namespace alpenglow::view
