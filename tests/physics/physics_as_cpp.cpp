// Compiled by compile_physics.cmake with PRECISION = physics_f32 or physics_f64: the same calls as
// physics.comp, where every literal and conversion must have the precision's type.
#include <type_traits>

#include "atmosphere/parameters/physics_cpp.h"

namespace physics = alpenglow::PRECISION;
using physics::Real;

static_assert(std::is_same_v<Real, float> || std::is_same_v<Real, double>);
static_assert(std::is_same_v<decltype(physics::rayleighPhase(Real(0))), Real>);
static_assert(
    std::is_same_v<decltype(physics::extinction(physics::Medium{}, Real(0))), physics::Spectrum>);

physics::Spectrum callEachFile(const physics::Medium& medium) {
  const physics::Ray ray =
      physics::makeRay(medium, Real(2), Real(0.1), Real(0.99), Real(0.5), Real(0.3));
  const physics::Spectrum depth = physics::opticalDepthToTop(medium, ray.h, ray.mu, 500) +
                                  physics::opticalDepthOfSegment(medium, ray.h, ray.mu, ray.extent);
  const physics::MomentShape shape{};
  const physics::RaySegment segment = physics::makeSegment(medium, ray, Real(0), ray.extent);
  const physics::SkyViewParams view{Real(1.5), Real(1.6), Real(1)};
  const physics::Real2 at =
      physics::depthCoordinate(medium, shape, ray.h, ray.mu) +
      physics::segmentNode(segment, Real(0.5)) +
      physics::gridCoordinate(physics::skyViewGrid(view, Real(128), Real(160)), view,
                              physics::angleFromNadir(ray.mu, Real(0.5)), Real(0.5),
                              ray.hitsGround);
  const physics::AerialSegment aerial =
      physics::aerialSegment(medium, physics::aerialView(medium, view, ray.h), ray);
  if (at[0] > physics::aerialU(aerial, physics::aerialTexelDistance(aerial, 3)))
    return physics::reflectedRadiance(medium.groundAlbedo, depth, depth);
  const Real u = physics::scatteringUmu(medium, ray.h, ray.mu, ray.hitsGround);
  return depth * (u + physics::miePhase(medium.mieAsymmetry, ray.nu));
}
