// The backward path tracer: from the observer against the light, all channels on one path.
// Distances and directions are drawn by importance with the help of a rough solution, LightGuide.
#pragma once

#include <alpenglow/reference.h>

#include "atmosphere/model/query.h"
#include "atmosphere/reference/columns.h"
#include "atmosphere/reference/directions.h"
#include "atmosphere/reference/light_guide.h"
#include "atmosphere/reference/random.h"

namespace alpenglow::reference {

/// More events than any path has; stands for "all orders".
inline constexpr uint32_t kAllOrders = 0xFFFFFFFFu;

/// Where light is gathered: a place and the sun's direction there, the vertical being z.
struct Observer {
  double h = 0.0;
  Vector sun{0.0, 0.0, 1.0};
};

class PathTracer {
 public:
  explicit PathTracer(const physics_f64::Medium& medium);
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

  /// About what the two estimate for all orders.
  physics_f64::Spectrum roughSky(const Observer& observer, const Vector& view, double length) const;
  physics_f64::Spectrum roughIrradiance(const Observer& observer) const;

 private:
  struct Path;
  struct Hit;
  struct Drawn;
  bool step(Path& path, double length, bool direct, bool sunAtEnd, PathSampler& sampler) const;
  bool atAir(Path& path, const Hit& hit, bool sunAtEnd, PathSampler& sampler) const;
  bool atGround(Path& path, const Hit& hit, PathSampler& sampler) const;
  Drawn drawInAir(const Path& path, const Hit& hit, const GuideLight& light, double rayleighShare,
                  PathSampler& sampler) const;
  Drawn drawAbove(const Vector& normal, const Vector& sun, double h, double muS,
                  PathSampler& sampler) const;
  void follow(Path& path, PathSampler& sampler) const;
  physics_f64::Spectrum sunlight(double h, double muS) const;

  physics_f64::Medium medium_;
  Columns columns_;
  LightGuide guide_;
};

}  // namespace alpenglow::reference
