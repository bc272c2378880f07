#include "atmosphere/model/query.h"

#include <algorithm>
#include <cmath>

namespace alpenglow {

ResolvedQuery resolveQuery(const physics_f64::Medium& medium, const ProbeQuery& query) {
  const double mu = std::cos(query.viewZenith);
  const double muS = std::cos(query.sunZenith);
  const double sine = std::sin(query.viewZenith);
  const double nu =
      std::clamp(mu * muS + sine * std::sin(query.sunZenith) * std::cos(query.azimuth), -1.0, 1.0);
  ResolvedQuery resolved;
  resolved.ray = physics_f64::makeRay(medium, query.altitude_m, mu, sine, muS, nu);
  const physics_f64::Ray& ray = resolved.ray;
  const bool whole = query.distance_m < 0.0;
  const double reach = whole ? ray.extent : std::min(query.distance_m - ray.start, ray.extent);
  if (!ray.inAtmosphere || query.distance_m == 0.0 || reach < 0.0) return resolved;
  resolved.length = std::max(reach, 0.0);
  resolved.endsOnGround = ray.hitsGround && reach >= ray.extent;
  resolved.empty = resolved.length == 0.0 && !resolved.endsOnGround;
  return resolved;
}

}  // namespace alpenglow
