// Which sun the error of a query is judged by.
#include <alpenglow/reference/reference.h>

#include <algorithm>
#include <cmath>

#include "atmosphere/parameters/query.h"
#include "atmosphere/reference/single_scattering.h"

namespace alpenglow {
namespace reference {

double bandSunElevation(const physics_f64::Medium& medium, const ProbeQuery& query) {
  double muS = std::cos(query.sunZenith);
  if (query.kind == QueryKind::Ray && query.altitude_m > medium.thickness) {
    ProbeQuery whole = query;
    whole.bounded = false;
    whole.distance_m = 0.0;
    const ResolvedQuery resolved = resolveQuery(medium, whole);
    if (!resolved.empty) {
      const physics_f64::Ray& ray = resolved.ray;
      const double lowest = -physics_f64::radiusAt(medium, ray.h) * ray.mu;
      const double t = ray.hitsGround ? ray.extent : std::clamp(lowest, 0.0, ray.extent);
      const double h = ray.hitsGround ? 0.0 : physics_f64::altitudeAt(medium, ray.h, ray.mu, t);
      muS = physics_f64::muSAt(medium, ray.h, ray.muS, ray.nu, t, h);
    }
  }
  return std::asin(std::clamp(muS, -1.0, 1.0));
}

}  // namespace reference

inline namespace v1_0 {

double bandSunElevation(const Parameters& parameters, const ProbeQuery& query) {
  if (reference::checkQuery(query, {}) != Status::Ok || validate(parameters, {}) != Status::Ok)
    return 0.0;
  return reference::bandSunElevation(makeMediumF64(parameters), query);
}

}  // namespace v1_0
}  // namespace alpenglow
