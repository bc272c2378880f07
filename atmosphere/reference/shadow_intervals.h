// Which parts of a view ray lie in the shadow of meshes: exact in double, without marching. In the
// plane of the ray and the sun each triangle is a segment, and its part sunward of the ray shadows
// the segment that it hides from the sun.
#pragma once

#include "atmosphere/reference/mesh_rays.h"
#include "atmosphere/reference/optical_depth.h"

namespace alpenglow::reference {

/// Shadows that lie no farther apart than absolute_m + relative * their distance are one.
struct ShadowGap {
  double absolute_m = 1e-4;
  double relative = 1e-6;
};

/// The parts of the ray's first `length` metres that the meshes hide from a parallel beam out of
/// the direction `sun`: sorted, apart. `view` and `sun` are unit vectors in the meshes' frame.
/// Within 1e-8 of view = +-sun the plane is undefined; there the ray itself is what the meshes cut.
std::vector<RayInterval> shadowIntervals(const MeshRays& meshes, const Vector& origin,
                                         const Vector& view, const Vector& sun, double length,
                                         const ShadowGap& gap = {});

}  // namespace alpenglow::reference
