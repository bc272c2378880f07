// Light along a view ray among opaque meshes: single scattering between exact shadows, and
// path-traced multiple scattering. Rays are in the planet's frame, per unit solar irradiance.
#pragma once

#include "atmosphere/reference/estimate.h"
#include "atmosphere/reference/shadow_intervals.h"

namespace alpenglow::reference {

/// From `position` (inside the atmosphere) towards `view` under a sun in direction `sun`, both unit
/// vectors.
struct SceneRay {
  Vector position{0.0}, view{0.0}, sun{0.0};
};

/// What ends a ray: a mesh, the ground, or the top of the atmosphere.
struct RayEnd {
  double length = 0.0;  ///< Metres.
  bool onSurface = false;
  Vector normal{0.0};  ///< Of the surface, towards the ray.
  physics_f64::Spectrum albedo{0.0};
};

RayEnd endOf(const Medium& medium, const Scene& scene, const SceneRay& ray);

/// Light scattered once in the lit parts of the ray's first `length` metres (equation 13 of the
/// paper, one part after another), with its quadrature's error; each to about `tolerance` times
/// itself. Both planet's shadow and `shadow` are dark. Positions outside the atmosphere are
/// allowed.
Estimate litScattering(const Medium& medium, const SceneRay& ray, double length,
                       std::span<const RayInterval> shadow, double tolerance);

/// Per unit solar irradiance, with standard errors.
struct SceneLight {
  RayEnd end;
  Estimate single;    ///< Inscattering of order 1 along the ray.
  Estimate multiple;  ///< Inscattering of all further orders, light from surfaces included.
  Estimate air;       ///< Their sum.
  Estimate surface;   ///< Radiance that leaves the surface at the ray's end, towards the ray.
};

/// Path traced by options.samples paths (0: as many as kLeastBatches have), whole batches, for the
/// atmosphere and for the surface each. `tracer` was made with `scene`.
SceneLight traceSceneRay(const PathTracer& tracer, const Scene& scene, const SceneRay& ray,
                         const ReferenceOptions& options);

}  // namespace alpenglow::reference
