// Checks of LightShaftDesc, and of the scene depth.
#include <algorithm>
#include <cmath>

#include "atmosphere/passes/light_shaft_pass.h"

namespace alpenglow::passes {

LightShaftSettings completed(const LightShaftSettings& desc) {
  LightShaftSettings full = desc;
  if (full.shadowMapSize == 0) full.shadowMapSize = 2048;
  if (full.meshSize == 0) full.meshSize = std::min(1024u, full.shadowMapSize);
  if (full.multipleLoss == 0.0) full.multipleLoss = 0.7;
  full.multipleLoss = std::max(full.multipleLoss, 0.0);
  if (full.stepCount == 0) full.stepCount = 32;
  if (full.vertexStride == 0) full.vertexStride = 12;
  return full;
}

Status checkLightShaftSettings(const engine::Device& device, const LightShaftSettings& desc) {
  if (desc.method > LightShaftMethod::RayMarch) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "LightShaftDesc::method is %u, but this enumeration ends at 3.",
                       static_cast<uint32_t>(desc.method));
  }
  const char* later = desc.lightMask > 1     ? "lightMask is beyond 1"
                      : desc.listLength != 0 ? "listLength is not 0"
                      : desc.hostPipelines   ? "hostPipelines is true"
                                             : nullptr;
  if (later != nullptr) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "LightShaftDesc::%s, which this version doesn't support: leave it at 0.",
                       later);
  }
  if (desc.projection == Projection::Fisheye) {
    return device.fail(Status::Unsupported, VK_SUCCESS,
                       "ViewDesc::projection is Fisheye, but shadows are drawn as triangles: "
                       "Perspective or Orthographic is expected.");
  }
  const uint32_t most = device.limits().maxImageDimension2D;
  if (desc.shadowMapSize < 16 || desc.shadowMapSize > most) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "LightShaftDesc::shadowMapSize is %u, but must be from 16 to %u texels.",
                       desc.shadowMapSize, most);
  }
  if (desc.meshSize < 2 || desc.meshSize > desc.shadowMapSize) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "LightShaftDesc::meshSize is %u, but must be from 2 to shadowMapSize, %u.",
                       desc.meshSize, desc.shadowMapSize);
  }
  if (!(desc.multipleLoss <= 1.0)) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "LightShaftDesc::multipleLoss is %g, but must be at most 1.",
                       desc.multipleLoss);
  }
  if (desc.method == LightShaftMethod::ShadowVolume && !desc.adjacency) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "LightShaftDesc::adjacency is false with LightShaftMethod::ShadowVolume, "
                       "but silhouettes need "
                       "casters with adjacency.");
  }
  if (desc.stepCount > 4096) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "LightShaftDesc::stepCount is %u, but must be at most 4096.",
                       desc.stepCount);
  }
  const VkPhysicalDeviceLimits& limits = device.limits();
  if (desc.vertexStride % 4 != 0 || desc.vertexOffset % 4 != 0 ||
      desc.vertexStride > limits.maxVertexInputBindingStride ||
      uint64_t{desc.vertexOffset} + 12 > desc.vertexStride) {
    return device.fail(Status::InvalidArgument, VK_SUCCESS,
                       "LightShaftDesc has vertexStride %u and vertexOffset %u, but both must be "
                       "multiples of 4, and three floats must fit into the stride, at most %u.",
                       desc.vertexStride, desc.vertexOffset, limits.maxVertexInputBindingStride);
  }
  return Status::Ok;
}

Status checkViewport(const engine::Device& device, const VkExtent2D& whole,
                     const FrameState& draw) {
  const VkRect2D& area = draw.viewport;
  const int64_t right = int64_t{area.offset.x} + area.extent.width;
  const int64_t bottom = int64_t{area.offset.y} + area.extent.height;
  if (right <= whole.width && bottom <= whole.height) return Status::Ok;
  return device.fail(Status::InvalidArgument, VK_SUCCESS,
                     "Camera::viewport reaches to pixel (%lld, %lld), but the scene's depth has %u "
                     "x %u pixels.",
                     static_cast<long long>(right), static_cast<long long>(bottom), whole.width,
                     whole.height);
}

Status checkCasters(const engine::Device& device, const CasterSet& casters) {
  const PlanetBox& box = casters.bounds;
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

}  // namespace alpenglow::passes
