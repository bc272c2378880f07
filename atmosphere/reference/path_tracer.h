// The backward path tracer: from the observer against the light, all channels on one path.
// Distances and directions are drawn by importance with the help of a rough solution, LightGuide.
#pragma once

#include <alpenglow/reference/reference.h>

#include "atmosphere/parameters/query.h"
#include "atmosphere/reference/columns.h"
#include "atmosphere/reference/directions.h"
#include "atmosphere/reference/light_guide.h"
#include "atmosphere/reference/mesh_rays.h"
#include "atmosphere/reference/random.h"

namespace alpenglow::reference {

/// More events than any path has; stands for "all orders".
inline constexpr uint32_t kAllOrders = 0xFFFFFFFFu;

/// Where light is gathered: a place and the sun's direction there, the vertical being z.
struct Observer {
  double h = 0.0;
  Vector sun{0.0, 0.0, 1.0};
};

/// Opaque objects in the atmosphere. They block light and reflect it by Lambert's law on both
/// sides.
struct Scene {
  MeshRays meshes;
  std::vector<physics_f64::Spectrum> albedo;  ///< Of each mesh.
  /// False: meshes let direct sunlight pass, and nothing else: this separates the effect of shadows
  /// from the rest.
  bool hidesSun = true;
};

/// Rays from a surface begin this far above it, in metres: well above rounding.
inline constexpr double kSurfaceGap = 1e-4;

class PathTracer {
 public:
  /// `scene`: outlives the tracer; null for the bare planet, whose numbers it leaves as they are.
  /// The rough solution ignores the scene and only guides: all estimates remain unbiased.
  explicit PathTracer(const physics_f64::Medium& medium, const Scene* scene = nullptr);
  PathTracer(const PathTracer&) = delete;
  PathTracer& operator=(const PathTracer&) = delete;
  const physics_f64::Medium& medium() const { return medium_; }
  const Columns& columns() const { return columns_; }

  /// One path's estimate of the light scattered along the first `length` metres of a ray, by paths
  /// of at least `least` (1 or 2) and at most `most` events. `relative`: what the channels count
  /// for.
  physics_f64::Spectrum skySample(const Observer& observer, const Vector& view, double length,
                                  uint32_t least, uint32_t most,
                                  const physics_f64::Spectrum& relative,
                                  PathSampler& sampler) const;

  /// One path's estimate of the irradiance of the sky on a horizontal surface, by paths of 1 to
  /// `most` events before the surface.
  physics_f64::Spectrum irradianceSample(const Observer& observer, uint32_t most,
                                         PathSampler& sampler) const;

  /// Light of a ray's first event in the atmosphere, and of those after it.
  struct AerialLight {
    physics_f64::Spectrum single{0.0}, multiple{0.0};
    double t = 0.0;  ///< Distance of the first event.
  };
  /// One path's estimate of the light scattered along the first `length` metres of a ray, given in
  /// the planet's frame, inside the atmosphere; nothing may lie in its way. `relative` as above.
  /// Without `withSingle` paths are drawn for what is multiple alone, and single is 0.
  AerialLight airSample(const Vector& position, const Vector& view, const Vector& sun,
                        double length, bool withSingle, const physics_f64::Spectrum& relative,
                        PathSampler& sampler) const;

  /// One path's estimate of the radiance that leaves a surface, whose normal points to the side
  /// looked at, by paths of any number of events.
  physics_f64::Spectrum surfaceSample(const Vector& position, const Vector& normal,
                                      const Vector& sun, const physics_f64::Spectrum& albedo,
                                      PathSampler& sampler) const;

  /// About what the first two estimate for all orders.
  physics_f64::Spectrum roughSky(const Observer& observer, const Vector& view, double length) const;
  physics_f64::Spectrum roughIrradiance(const Observer& observer) const;

 private:
  struct Path;
  struct Hit;
  struct Drawn;
  bool step(Path& path, double length, bool direct, bool sunAtEnd, PathSampler& sampler) const;
  bool atAir(Path& path, const Hit& hit, bool sunAtEnd, PathSampler& sampler) const;
  bool atSurface(Path& path, const Hit& hit, PathSampler& sampler) const;
  Drawn drawInAtmosphere(const Path& path, const Hit& hit, const GuideLight& light,
                         double rayleighShare, PathSampler& sampler) const;
  Drawn drawAbove(const Vector& normal, const Vector& vertical, const Vector& sun, double h,
                  double muS, PathSampler& sampler) const;
  void follow(Path& path, PathSampler& sampler) const;
  physics_f64::Spectrum sunlight(double h, double muS) const;
  bool isHidden(const Vector& position, const Vector& sun, double gap) const;

  physics_f64::Medium medium_;
  const Scene* scene_;
  Columns columns_;
  LightGuide guide_;
};

}  // namespace alpenglow::reference
