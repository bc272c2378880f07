#include "atmosphere/camera/projection.h"

#include <cmath>

#include "atmosphere/camera/viewport_partition.h"

namespace alpenglow {
namespace passes {

DepthScale depthScale(Projection projection, DepthConvention convention, const DepthRange& range) {
  const double n = range.near_m, f = range.far_m;
  const bool reversed = convention == DepthConvention::Reversed;
  if (projection == Projection::Orthographic) {
    const double slope = 1.0 / (f - n);
    return reversed ? DepthScale{f * slope, -slope} : DepthScale{-n * slope, slope};
  }
  if (f == 0.0) return reversed ? DepthScale{0.0, n} : DepthScale{1.0, -n};
  const double slope = 1.0 / (f - n);
  return reversed ? DepthScale{-n * slope, f * n * slope} : DepthScale{f * slope, -f * n * slope};
}

PictureEdges pictureEdges(Projection projection, const FrameState& draw) {
  const ViewportSize size = viewportSize(draw);
  const EyeCamera& c = draw.camera;
  const double half = projection == Projection::Orthographic ? 0.5 * c.height_m
                      : projection == Projection::Fisheye    ? 1.0
                                                             : std::tan(0.5 * c.fov);
  const double aspect = projection == Projection::Fisheye ? 1.0 : size.width / size.height;
  const std::array<double, 3> right = cameraRight(c);
  PictureEdges edges;
  for (size_t i = 0; i < 3; ++i) {
    edges.right[i] = right[i] * half * aspect;
    edges.down[i] = -c.up[i] * half;
  }
  return edges;
}

void clipFromCamera(Projection projection, DepthConvention convention, const FrameState& draw,
                    double matrix[16]) {
  const PictureEdges edges = pictureEdges(projection, draw);
  const DepthScale depth = depthScale(projection, convention, draw.depth);
  const bool parallel = projection == Projection::Orthographic;
  const double right2 = dot(edges.right, edges.right), down2 = dot(edges.down, edges.down);
  for (int i = 0; i < 3; ++i) {
    matrix[4 * i] = edges.right[i] / right2;
    matrix[4 * i + 1] = edges.down[i] / down2;
    matrix[4 * i + 2] = draw.camera.forward[i] * (parallel ? depth.b : depth.a);
    matrix[4 * i + 3] = parallel ? 0.0 : draw.camera.forward[i];
  }
  matrix[12] = matrix[13] = 0.0;
  matrix[14] = parallel ? depth.a : depth.b;
  matrix[15] = parallel ? 1.0 : 0.0;
}

}  // namespace passes

}  // namespace alpenglow
