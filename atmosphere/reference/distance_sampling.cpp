#include "atmosphere/reference/distance_sampling.h"

#include <numbers>

namespace alpenglow::reference {
namespace {

using physics_f64::Spectrum;

/// Sums below it have no accurate reciprocal; they count as 0.
constexpr double kNothing = 1e-250;
constexpr double kGuided = 0.88, kUnguided = 0.117, kAnywhere = 0.003;

double sumOf(const Spectrum& s) { return s.x + s.y + s.z; }

}  // namespace

DistanceSampling::DistanceSampling(const Medium& medium, const LightGuide& guide,
                                   const RaySegment& segment, double muS, double nu,
                                   const Spectrum& counts, bool direct, const EndSurface& surface)
    : nodes_(medium, segment, muS, nu, RayNodes::kFine) {
  const int count = nodes_.count();
  if (count < 2) {  // No atmosphere along the ray; the surface may still be there.
    surfaceProbability_ = surface.albedo != nullptr ? 1.0 : 0.0;
    possible_ = surface.albedo != nullptr;
    return;
  }
  const Spectrum& betaR = medium.rayleighScattering;
  const Spectrum& betaM = medium.mieScattering;
  const Spectrum sunR = direct ? betaR * physics_f64::rayleighPhase(nu) : Spectrum(0.0);
  const Spectrum sunM =
      direct ? betaM * physics_f64::miePhase(medium.mieAsymmetry, nu) : Spectrum(0.0);
  std::array<double, kMost> unguided;
  double guidedSum = 0.0, unguidedSum = 0.0;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<size_t>(i);
    const RayNode& n = nodes_[i];
    const GuideLight light = guide.at(n.h, n.muS);
    const Spectrum left = counts * n.transmittance;
    weights_[k] = sumOf(left * ((betaR * n.rayleigh + betaM * n.mie) * light.mean +
                                (sunR * n.rayleigh + sunM * n.mie) * light.sunlight));
    unguided[k] = sumOf(left * (betaR * n.rayleigh + betaM * n.mie));
    if (i > 0) {
      const double step = 0.5 * (n.t - nodes_[i - 1].t);
      guidedSum += step * (weights_[k - 1] + weights_[k]);
      unguidedSum += step * (unguided[k - 1] + unguided[k]);
    }
  }
  double surfaceLight = 0.0;
  if (surface.albedo != nullptr) {
    const RayNode& n = nodes_[count - 1];
    const GuideLight light = guide.at(surface.h, n.muS);
    const double cosSun = surface.isMesh ? surface.cosSun : n.muS;
    const Spectrum incident =
        light.sunlight * (std::max(cosSun, 0.0) / std::numbers::pi) + light.mean;
    surfaceLight = sumOf(counts * n.transmittance * *surface.albedo * incident);
  }
  const bool reflects = surface.albedo != nullptr && sumOf(*surface.albedo) > 0.0;
  if (unguidedSum > kNothing) {
    // The guide ignores shadows: sunlight in the atmosphere before a mesh is less certain than on
    // the mesh.
    const double least = surface.isMesh ? 0.2 : 0.02;
    const double all = guidedSum + surfaceLight;
    if (reflects) {
      surfaceProbability_ = std::clamp(all > kNothing ? surfaceLight / all : 0.5, least, 0.98);
    }
  } else {
    surfaceProbability_ = reflects ? 1.0 : 0.0;
  }
  possible_ = unguidedSum > kNothing || reflects;
  if (!(unguidedSum > kNothing)) return;
  const double guided = guidedSum > kNothing ? kGuided / guidedSum : 0.0;
  const double other = (guidedSum > kNothing ? kUnguided : kGuided + kUnguided) / unguidedSum;
  for (int i = 0; i < count; ++i) {
    const auto k = static_cast<size_t>(i);
    weights_[k] = guided * weights_[k] + other * unguided[k] + kAnywhere / segment.length;
    if (i > 0) {
      sums_[k] =
          sums_[k - 1] + 0.5 * (nodes_[i].t - nodes_[i - 1].t) * (weights_[k - 1] + weights_[k]);
    }
  }
}

DistanceSample DistanceSampling::sample(double u, double share) const {
  const auto last = static_cast<size_t>(nodes_.count() - 1);
  const double sum = sums_[last];
  const double target = u * sum;
  size_t k = 0;
  while (k + 1 < last && sums_[k + 1] < target) ++k;
  const double t0 = nodes_[static_cast<int>(k)].t;
  const double step = nodes_[static_cast<int>(k) + 1].t - t0;
  const double w0 = weights_[k], slope = weights_[k + 1] - w0;
  // w0 x + slope x^2 / 2 = what is left of the target, in units of the step.
  const double rest = std::max(target - sums_[k], 0.0) / step;
  const double root = std::sqrt(std::max(w0 * w0 + 2.0 * slope * rest, 0.0));
  const double x = std::clamp(2.0 * rest / (w0 + root), 0.0, 1.0);
  return {t0 + x * step, share * (w0 + slope * x) / sum};
}

Spectrum DistanceSampling::lightAlong(const Medium& medium, const LightGuide& guide,
                                      const RaySegment& segment, double muS, double nu) {
  const RayNodes nodes(medium, segment, muS, nu, RayNodes::kFine);
  Spectrum sum(0.0), before(0.0);
  for (int i = 0; i < nodes.count(); ++i) {
    const RayNode& n = nodes[i];
    const Spectrum here = n.transmittance * guide.at(n.h, n.muS).mean *
                          (medium.rayleighScattering * n.rayleigh + medium.mieScattering * n.mie);
    if (i > 0) sum += 0.5 * (n.t - nodes[i - 1].t) * (before + here);
    before = here;
  }
  return sum;
}

}  // namespace alpenglow::reference
