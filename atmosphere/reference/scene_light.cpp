#include "atmosphere/reference/scene_light.h"

#include "atmosphere/reference/single_scattering.h"

namespace alpenglow::reference {
namespace {

/// A probe query counts angles at the observer; by tangents, as cosines would lose small ones.
double angleBetween(const Vector& a, const Vector& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

ProbeQuery queryOf(const Medium& medium, const SceneRay& ray, double length) {
  const Vector up = glm::normalize(ray.position);
  ProbeQuery query;
  query.altitude_m = std::max(glm::length(ray.position) - medium.bottomRadius, 0.0);
  query.zenith = angleBetween(up, ray.view);
  query.sunZenith = angleBetween(up, ray.sun);
  const Vector across = glm::cross(up, ray.view);
  query.azimuth = std::atan2(glm::dot(across, ray.sun), glm::dot(glm::cross(across, up), ray.sun));
  query.bounded = true;
  query.distance_m = length;
  return query;
}

/// One part of the ray's light, batch by batch.
struct SceneRound {
  const PathTracer* tracer;
  const SceneRay* ray;
  const RayEnd* end;
  physics_f64::Spectrum relative;
  uint64_t seed;
  std::vector<physics_f64::Spectrum>*single, *multiple, *air, *surface;
};

constexpr uint64_t kEndStream = uint64_t{1} << 41;

void traceSceneBatch(void* context, uint32_t i) {
  const SceneRound& round = *static_cast<const SceneRound*>(context);
  const SceneRay& ray = *round.ray;
  const double share = 1.0 / static_cast<double>(kBatchPaths);
  PathSampler sampler(round.seed, i);
  physics_f64::Spectrum single(0.0), multiple(0.0);
  for (uint64_t k = 0; k < kBatchPaths; ++k) {
    const PathTracer::AerialLight light = round.tracer->airSample(
        ray.position, ray.view, ray.sun, round.end->length, true, round.relative, sampler);
    single += light.single * share;
    multiple += light.multiple * share;
  }
  (*round.single)[i] = single;
  (*round.multiple)[i] = multiple;
  (*round.air)[i] = single + multiple;
  if (!round.end->onSurface) return;
  PathSampler endSampler(round.seed, kEndStream + i);
  const Vector place = ray.position + round.end->length * ray.view;
  for (uint64_t k = 0; k < kBatchPaths; ++k) {
    (*round.surface)[i] += share * round.tracer->surfaceSample(place, round.end->normal, ray.sun,
                                                               round.end->albedo, endSampler);
  }
}

}  // namespace

RayEnd endOf(const Medium& medium, const Scene& scene, const SceneRay& ray) {
  const double r = glm::length(ray.position);
  const double h = std::clamp(r - medium.bottomRadius, 0.0, medium.thickness);
  const double mu = std::clamp(glm::dot(ray.position, ray.view) / r, -1.0, 1.0);
  RayEnd end;
  end.onSurface = physics_f64::rayHitsGround(medium, h, mu);
  end.length = end.onSurface ? physics_f64::distanceToGround(medium, h, mu)
                             : physics_f64::distanceToTop(medium, h, mu);
  if (const auto hit = scene.meshes.closest(ray.position, ray.view, 0.0, end.length)) {
    end.length = hit->t;
    end.onSurface = true;
    end.normal = glm::dot(hit->normal, ray.view) > 0.0 ? -hit->normal : hit->normal;
    end.albedo = scene.albedo[hit->mesh];
  } else if (end.onSurface) {
    end.normal = glm::normalize(ray.position + end.length * ray.view);
    end.albedo = medium.groundAlbedo;
  }
  return end;
}

Estimate litScattering(const Medium& medium, const SceneRay& ray, double length,
                       std::span<const RayInterval> shadow, double tolerance) {
  const ReferenceAnswer answer =
      singleScattering(medium, queryOf(medium, ray, length), tolerance, shadow);
  return {answer.value.skyRadiance, answer.standardError.skyRadiance};
}

SceneLight traceSceneRay(const PathTracer& tracer, const Scene& scene, const SceneRay& ray,
                         const ReferenceOptions& options) {
  SceneLight result;
  result.end = endOf(tracer.medium(), scene, ray);
  const uint64_t batches =
      options.pathCount > 0
          ? std::max<uint64_t>((options.pathCount + kBatchPaths - 1) / kBatchPaths, 2)
          : kLeastBatches;
  const std::vector<physics_f64::Spectrum> none(batches, physics_f64::Spectrum(0.0));
  auto single = none, multiple = none, air = none, surface = none;
  // All channels count alike; their light is about in the proportion that scattering once has.
  const Estimate rough = litScattering(tracer.medium(), ray, result.end.length, {}, 1e-3);
  physics_f64::Spectrum relative;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    relative[static_cast<glm::length_t>(c)] = 1.0 / (3.0 * std::max(rough.value[c], 1e-30));
  }
  SceneRound round{&tracer, &ray,      &result.end, relative, options.seed,
                   &single, &multiple, &air,        &surface};
  if (options.parallelFor != nullptr) {
    options.parallelFor(options.parallelUser, static_cast<uint32_t>(batches), traceSceneBatch,
                        &round);
  } else {
    for (uint32_t i = 0; i < batches; ++i) traceSceneBatch(&round, i);
  }
  result.single = estimateOf(single);
  result.multiple = estimateOf(multiple);
  result.air = estimateOf(air);
  if (result.end.onSurface) result.surface = estimateOf(surface);
  return result;
}

}  // namespace alpenglow::reference
