// Cameras from a host's matrices.
#include <alpenglow/camera.h>

#include <algorithm>
#include <cmath>

#include "atmosphere/camera/camera_math.h"
#include "atmosphere/parameters/sentence.h"

namespace alpenglow {
inline namespace v1_0 {
namespace {

Status refuse(const DiagnosticSink& sink, const char* matrix, const char* what) {
  return parameters::report(sink, Status::InvalidArgument,
                            parameters::Sentence()
                                << "cameraFromMatrices got a " << matrix << " " << what << ".");
}

bool small(double value, double scale) { return std::abs(value) <= 1e-4 * std::abs(scale); }

/// View axes are columns 0 to 2 of worldFromView: orthonormal.
bool rigid(const double m[16]) {
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const double product = passes::dot(m + 4 * i, m + 4 * j);
      if (!(std::abs(product - (i == j ? 1.0 : 0.0)) < 1e-4)) return false;
    }
  }
  return m[3] == 0.0 && m[7] == 0.0 && m[11] == 0.0 && m[15] == 1.0;
}

/// Distances at which depth is that of the near and the far plane; far 0: infinitely far. Depth is
/// -a + b / z (perspective, z ahead) or -a z + b.
bool planes(double a, double b, bool parallel, DepthConvention depth, Camera* camera) {
  const bool reversed = depth == DepthConvention::Reversed;
  const double atNear = reversed ? 1.0 : 0.0, atFar = reversed ? 0.0 : 1.0;
  if (parallel) {
    if (a == 0.0) return false;
    camera->nearPlane = (b - atNear) / a;
    camera->farPlane = (b - atFar) / a;
    return camera->farPlane > camera->nearPlane;
  }
  camera->nearPlane = b / (atNear + a);
  const double far = atFar + a;
  // Single-precision matrices miss infinity by rounding.
  camera->farPlane = std::abs(far) < 1e-6 ? 0.0 : b / far;
  return camera->nearPlane > 0.0 && std::isfinite(camera->nearPlane) &&
         (camera->farPlane == 0.0 || camera->farPlane > camera->nearPlane);
}

}  // namespace

Status cameraFromMatrices(const double worldFromView[16], const double clipFromView[16],
                          DepthConvention depth, bool clipYUp, Camera* camera,
                          const DiagnosticSink& sink) {
  if (worldFromView == nullptr || clipFromView == nullptr || camera == nullptr)
    return refuse(sink, "null argument", "but needs all of them");
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(worldFromView[i]))
      return refuse(sink, "worldFromView", "that is not finite");
    if (!std::isfinite(clipFromView[i])) return refuse(sink, "clipFromView", "that is not finite");
  }
  if (!rigid(worldFromView))
    return refuse(sink, "worldFromView",
                  "with a scale or shear, but needs a rotation and a position");
  const double* c = clipFromView;
  const double x = c[0], y = clipYUp ? c[5] : -c[5];
  const bool parallel = c[11] == 0.0 && c[15] == 1.0;
  if (!parallel && !(c[11] == -1.0 && c[15] == 0.0))
    return refuse(sink, "clipFromView", "that is neither a perspective along -z nor orthographic");
  if (!(x > 0.0 && y > 0.0)) {
    return refuse(sink, "clipFromView",
                  "that mirrors the picture, but needs x to the right and y as clipYUp says");
  }
  if (!small(c[1], x) || !small(c[4], x) || !small(c[3], 1.0) || !small(c[7], 1.0))
    return refuse(sink, "clipFromView", "with a shear, which this version doesn't draw");
  if (!small(c[2], 1.0) || !small(c[6], 1.0))
    return refuse(sink, "clipFromView",
                  "with an oblique near plane, which this version doesn't draw");
  const double* offset = parallel ? c + 12 : c + 8;
  if (std::abs(offset[0]) > 1e-9 || std::abs(offset[1]) > 1e-9)
    return refuse(sink, "clipFromView",
                  "of an off-centre frustum, which this version doesn't draw");
  Camera made;
  made.viewport = camera->viewport;
  if (!planes(c[10], c[14], parallel, depth, &made)) {
    return refuse(
        sink, "clipFromView",
        "whose depths of the near and the far plane are not those of the DepthConvention");
  }
  for (int i = 0; i < 3; ++i) {
    made.position[i] = worldFromView[12 + i];
    made.forward[i] = -worldFromView[8 + i];
    made.up[i] = worldFromView[4 + i];
  }
  if (parallel)
    made.height = 2.0 / y;
  else
    made.fov = 2.0 * std::atan(1.0 / y);
  *camera = made;
  return Status::Ok;
}

}  // namespace v1_0
}  // namespace alpenglow
