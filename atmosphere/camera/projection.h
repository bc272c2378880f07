// Picture and depth of a camera, for all passes that draw into a host's scene.
#pragma once

#include "atmosphere/camera/picture.h"

namespace alpenglow::passes {

/// Depth in the picture is a + b / z of the distance z along Camera::forward (perspective), or
/// a + b z (orthographic).
struct DepthScale {
  double a, b;
};
DepthScale depthScale(Projection projection, DepthConvention convention, const DepthRange& range);

/// The edges of the picture to the right of its centre and below it: forward + x right + y down is
/// the ray at (x, y) in [-1, 1] (perspective), or x right + y down its origin, in metres
/// (orthographic).
struct PictureEdges {
  double right[3], down[3];
};
PictureEdges pictureEdges(Projection projection, const FrameState& draw);

/// Column-major, from metres off the camera in the planet's axes. Not for fisheyes.
void clipFromCamera(Projection projection, DepthConvention convention, const FrameState& draw,
                    double matrix[16]);

}  // namespace alpenglow::passes
