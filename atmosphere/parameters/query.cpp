#include "atmosphere/parameters/query.h"

#include <algorithm>
#include <cmath>

namespace alpenglow {

ResolvedQuery resolveQuery(const physics_f64::Medium& medium, const ProbeQuery& query) {
  const double mu = std::cos(query.zenith);
  const double muS = std::cos(query.sunZenith);
  const double sine = std::sin(query.zenith);
  const double nu =
      std::clamp(mu * muS + sine * std::sin(query.sunZenith) * std::cos(query.azimuth), -1.0, 1.0);
  ResolvedQuery resolved;
  resolved.ray = physics_f64::makeRay(medium, query.altitude_m, mu, sine, muS, nu);
  const physics_f64::Ray& ray = resolved.ray;
  const double distance = query.distance_m;
  const double reach = query.bounded ? std::min(distance - ray.start, ray.extent) : ray.extent;
  const bool nothing = query.bounded && distance == 0.0;
  if (!ray.inAtmosphere || nothing || reach < 0.0) return resolved;
  resolved.length = std::max(reach, 0.0);
  resolved.endsOnGround = ray.hitsGround && reach >= ray.extent;
  resolved.empty = resolved.length == 0.0 && !resolved.endsOnGround;
  return resolved;
}

}  // namespace alpenglow
