// What a host may ask of light shafts.
#include <algorithm>
#include <cmath>

#include "atmosphere/shafts/shaft_pass.h"

namespace alpenglow::shafts {

ShaftsDesc completed(const ShaftsDesc& desc) {
  ShaftsDesc full = desc;
  if (full.sunMapSize == 0) full.sunMapSize = 2048;
  if (full.reliefSize == 0) full.reliefSize = std::min(1024u, full.sunMapSize);
  if (full.multipleLoss == 0.0) full.multipleLoss = 0.7;
  full.multipleLoss = std::max(full.multipleLoss, 0.0);
  if (full.samples == 0) full.samples = 32;
  if (full.vertexStride == 0) full.vertexStride = 12;
  return full;
}

namespace {

Status checkScene(const engine::Device& device, const ShaftsDesc& desc) {
  const SceneDepth& scene = desc.sceneDepth;
  const VkPhysicalDeviceLimits& limits = device.limits();
  if (scene.view == VK_NULL_HANDLE || scene.extent.width == 0 || scene.extent.height == 0 ||
      scene.extent.width > limits.maxFramebufferWidth ||
      scene.extent.height > limits.maxFramebufferHeight) {
    return device.fail(
        Status::InvalidArgument, VK_SUCCESS,
        "ShaftsDesc::sceneDepth has %s view and %u x %u pixels, but needs a view and "
        "from 1 x 1 to %u x %u pixels.",
        scene.view == VK_NULL_HANDLE ? "no" : "a", scene.extent.width, scene.extent.height,
        limits.maxFramebufferWidth, limits.maxFramebufferHeight);
  }
  if ((device.formatProperties(scene.format).optimalTilingFeatures &
       VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT) == 0) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "ShaftsDesc::sceneDepth has VkFormat %d, but must have a depth format of "
                       "this device.",
                       static_cast<int>(scene.format));
  }
  return Status::Ok;
}

}  // namespace

Status checkShaftsDesc(const engine::Device& device, const ShaftsDesc& desc) {
  if (desc.method > ShaftMethod::March || desc.depth > DepthConvention::Reversed ||
      desc.projection > Projection::Orthographic) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ShaftsDesc has method %u, depth %u and projection %u, but the greatest are "
                       "2, 1 and 2.",
                       static_cast<uint32_t>(desc.method), static_cast<uint32_t>(desc.depth),
                       static_cast<uint32_t>(desc.projection));
  }
  if ((desc.without & ~(kTableEffects | kViewEffects)) != 0) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ShaftsDesc::without is 0x%x, but may have bits of kTableEffects and "
                       "kViewEffects alone.",
                       desc.without);
  }
  if (desc.projection == Projection::Fisheye) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "ShaftsDesc::projection is Fisheye, but shadows are drawn as triangles: "
                       "Perspective or Orthographic is expected.");
  }
  const uint32_t most = device.limits().maxImageDimension2D;
  if (desc.sunMapSize < 16 || desc.sunMapSize > most) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ShaftsDesc::sunMapSize is %u, but must be from 16 to %u texels.",
                       desc.sunMapSize, most);
  }
  if (desc.reliefSize < 2 || desc.reliefSize > desc.sunMapSize) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ShaftsDesc::reliefSize is %u, but must be from 2 to sunMapSize, %u.",
                       desc.reliefSize, desc.sunMapSize);
  }
  if (!(desc.multipleLoss <= 1.0)) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ShaftsDesc::multipleLoss is %g, but must be at most 1.", desc.multipleLoss);
  }
  if (desc.method == ShaftMethod::Paper && !desc.adjacency) {
    return device.fail(
        Status::InvalidArgument, VK_SUCCESS,
        "ShaftsDesc::adjacency is false with ShaftMethod::Paper, but silhouettes need "
        "casters with adjacency.");
  }
  if (desc.samples > 4096) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ShaftsDesc::samples is %u, but must be at most 4096.", desc.samples);
  }
  const VkPhysicalDeviceLimits& limits = device.limits();
  if (desc.vertexStride % 4 != 0 || desc.vertexOffset % 4 != 0 ||
      desc.vertexStride > limits.maxVertexInputBindingStride ||
      uint64_t{desc.vertexOffset} + 12 > desc.vertexStride) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "ShaftsDesc has vertexStride %u and vertexOffset %u, but both must be "
                       "multiples of 4, and three floats must fit into the stride, at most %u.",
                       desc.vertexStride, desc.vertexOffset, limits.maxVertexInputBindingStride);
  }
  return checkScene(device, desc);
}

Status checkViewport(const engine::Device& device, const ShaftsDesc& desc, const SkyDraw& draw) {
  const VkRect2D& area = draw.viewport;
  const VkExtent2D& whole = desc.sceneDepth.extent;
  const int64_t right = int64_t{area.offset.x} + area.extent.width;
  const int64_t bottom = int64_t{area.offset.y} + area.extent.height;
  if (right <= whole.width && bottom <= whole.height) return Status::Ok;
  return device.fail(
      Status::InvalidArgument, VK_SUCCESS,
      "SkyDraw::viewport reaches to pixel (%lld, %lld), but the scene's depth has %u "
      "x %u pixels.",
      static_cast<long long>(right), static_cast<long long>(bottom), whole.width, whole.height);
}

Status checkCasters(const engine::Device& device, const Casters& casters) {
  if (casters.draw == nullptr) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "Casters::draw is null, but a function that draws them is expected.");
  }
  const Box& box = casters.bounds;
  double away = 0.0;
  bool finite = true;
  for (size_t i = 0; i < 3; ++i) {
    away += box.center_m[i] * box.center_m[i];
    for (size_t j = 0; j < 3; ++j) finite = finite && std::abs(box.halfAxes_m[i][j]) < 1e12;
  }
  if (!finite || !(away > 0.0 && away < 1e30)) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "Casters::bounds has its centre at (%g, %g, %g) and a half axis (%g, %g, "
                       "%g), but must be finite, about a point away from the planet's centre.",
                       box.center_m[0], box.center_m[1], box.center_m[2], box.halfAxes_m[0][0],
                       box.halfAxes_m[0][1], box.halfAxes_m[0][2]);
  }
  return Status::Ok;
}

}  // namespace alpenglow::shafts
