// What a query asks of the path tracer.
#include <numbers>

#include "atmosphere/reference/estimate.h"

namespace alpenglow::reference {

Observer placeUnder(double h, double muS) {
  return {h, Vector(std::sqrt(std::max(1.0 - muS * muS, 0.0)), 0.0, muS)};
}

namespace {

uint32_t beforeLast(uint32_t orders) { return orders == kAllOrders ? kAllOrders : orders - 1; }

}  // namespace

Task rayTask(const Medium& medium, const ProbeQuery& query, const ReferenceAnswer& exact,
             uint32_t orders) {
  Task task;
  const ResolvedQuery resolved = resolveQuery(medium, query);
  if (resolved.empty || orders < 2) return task;
  const physics_f64::Ray& ray = resolved.ray;
  // At the ray's entry into the atmosphere only mu, mu_s and nu are left of the observer's angles.
  const double viewSine = std::sqrt(std::max(1.0 - ray.mu * ray.mu, 0.0));
  const double sunSine = std::sqrt(std::max(1.0 - ray.muS * ray.muS, 0.0));
  const double spread = viewSine * sunSine;
  const double cosine =
      spread > 1e-12 ? std::clamp((ray.nu - ray.mu * ray.muS) / spread, -1.0, 1.0) : 1.0;
  task.view = Vector(viewSine, 0.0, ray.mu);
  task.observer = {ray.h, Vector(sunSine * cosine,
                                 sunSine * std::sqrt((1.0 - cosine) * (1.0 + cosine)), ray.muS)};
  task.length = resolved.length;
  task.air = resolved.length > 0.0;
  task.most = orders;
  task.knownAir = exact.value.skyRadiance;
  task.surface = resolved.endsOnGround;
  task.surfaceMost = beforeLast(orders);
  if (task.surface) {
    task.surfacePlace =
        placeUnder(0.0, physics_f64::muSAt(medium, ray.h, ray.muS, ray.nu, resolved.length, 0.0));
    task.knownSurface = exact.value.groundRadiance;
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      task.surfaceFactor[c] = exact.value.transmittance[c] *
                              medium.groundAlbedo[static_cast<glm::length_t>(c)] / std::numbers::pi;
    }
  }
  return task;
}

Task irradianceTask(const Medium& medium, const ProbeQuery& query, uint32_t orders) {
  Task task;
  task.surface = query.altitude_m <= medium.thickness && orders >= 2;
  task.surfacePlace = placeUnder(query.altitude_m, std::cos(query.sunZenith));
  task.surfaceMost = beforeLast(orders);
  return task;
}

}  // namespace alpenglow::reference
