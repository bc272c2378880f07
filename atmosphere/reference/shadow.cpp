#include "atmosphere/reference/shadow.h"

#include <cmath>

namespace alpenglow::reference {
namespace {

/// Sine of the sun's angle above the horizon after a distance t.
double sunSine(const Medium& medium, const SunlitRay& ray, double t) {
  const double h = physics_f64::altitudeAt(medium, ray.segment.h, ray.segment.mu, t);
  const double muS = physics_f64::muSAt(medium, ray.segment.h, ray.muS, ray.nu, t, h);
  const double sine = std::sqrt(std::max(1.0 - muS * muS, 0.0));
  return (muS * medium.bottomRadius + sine * physics_f64::horizonRho(medium, h)) /
         physics_f64::radiusAt(medium, h);
}

/// The points behind the planet (seen from the sun) whose sunlight has its lowest point at
/// `altitude`: the ray through the half cylinder of radius Rg + altitude,
/// A t^2 + 2 B t + C = 0 where r mu_s + t nu < 0.
void addCylinder(const Medium& medium, const SunlitRay& ray, double altitude,
                 std::vector<double>& breaks) {
  const double h = ray.segment.h;
  const double rMuS = physics_f64::radiusAt(medium, h) * ray.muS;
  const double a = ray.sineSquared;
  const double b = ray.across;
  const double c = (h - altitude) * (2.0 * medium.bottomRadius + h + altitude) - rMuS * rMuS;
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0.0)) {
    return;
  }
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  for (double t : {q / a, c / q}) {
    if (std::isfinite(t) && rMuS + t * ray.nu < 0.0) {
      breaks.push_back(t);
    }
  }
}

/// The distance in [low, high] at which the sun's sine passes `level`; the ends lie on both sides.
double findSine(const Medium& medium, const SunlitRay& ray, double level, double low, double high) {
  const bool lowAbove = sunSine(medium, ray, low) > level;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((sunSine(medium, ray, middle) > level) == lowAbove ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// No closed form: the sine is sampled and its passages of +- the disc's radius are bisected.
void addDisc(const Medium& medium, const SunlitRay& ray, std::vector<double>& breaks) {
  std::vector<double> samples = smoothBreaks(medium, ray.segment);
  samples.insert(samples.end(), breaks.begin(), breaks.end());
  constexpr int kSamples = 512;
  for (int i = 1; i < kSamples; ++i) {
    samples.push_back(ray.segment.length * i / kSamples);
  }
  tidyBreaks(samples, ray.segment.length);
  for (size_t i = 0; i + 1 < samples.size(); ++i) {
    const double sine0 = sunSine(medium, ray, samples[i]);
    const double sine1 = sunSine(medium, ray, samples[i + 1]);
    for (double level : {-medium.sunSinRadius, medium.sunSinRadius}) {
      if ((sine0 > level) != (sine1 > level)) {
        breaks.push_back(findSine(medium, ray, level, samples[i], samples[i + 1]));
      }
    }
  }
}

}  // namespace

void addSunlightBreaks(const Medium& medium, const SunlitRay& ray, std::vector<double>& breaks) {
  addCylinder(medium, ray, 0.0, breaks);
  for (double side : {-1.0, 0.0, 1.0}) {
    addCylinder(medium, ray, medium.absorptionCenter + side * medium.absorptionHalfWidth, breaks);
  }
  if (medium.sunSinRadius > 0.0) {
    addDisc(medium, ray, breaks);
  }
}

}  // namespace alpenglow::reference
