#include "tests/baselines/baseline_reference.h"

#include <algorithm>
#include <cmath>

namespace alpenglow::testing {
namespace {

Vec along(const Vec& from, const Vec& direction, double t) {
  return {from[0] + t * direction[0], from[1] + t * direction[1], from[2] + t * direction[2]};
}

double rayleighPhase(double nu) { return 3.0 / (16.0 * kPi) * (1.0 + nu * nu); }

double cornetteShanks(double g, double nu) {
  return 3.0 / (8.0 * kPi) * (1.0 - g * g) * (1.0 + nu * nu) /
         ((2.0 + g * g) * std::pow(1.0 + g * g - 2.0 * g * nu, 1.5));
}

double henyeyGreenstein(double g, double nu) {
  return 1.0 / (4.0 * kPi) * (1.0 - g * g) / std::pow(1.0 + g * g - 2.0 * g * nu, 1.5);
}

}  // namespace

BaselineReference::Densities BaselineReference::densities(double h) const {
  Densities d;
  if (p_.rayleigh.present) d.rayleigh = std::exp(-h / p_.rayleigh.scaleHeight_m);
  if (p_.mie.present) d.mie = std::exp(-h / p_.mie.scaleHeight_m);
  if (p_.absorption.present) {
    d.absorption =
        std::max(0.0, 1.0 - std::abs(h - p_.absorption.center_m) / p_.absorption.halfWidth_m);
  }
  return d;
}

double BaselineReference::extinction(const Densities& d, uint32_t c) const {
  return d.rayleigh * p_.rayleigh.scattering_per_m[c] + d.mie * p_.mie.extinction_per_m[c] +
         d.absorption * p_.absorption.extinction_per_m[c];
}

double BaselineReference::scattering(const Densities& d, uint32_t c) const {
  return d.rayleigh * p_.rayleigh.scattering_per_m[c] + d.mie * p_.mie.scattering_per_m[c];
}

BaselineReference::Ray BaselineReference::makeRay(const Vec& from, const Vec& direction,
                                                  const Vec& sun) const {
  Ray ray{from, direction, sun};
  const double b = dot(from, direction), r2 = dot(from, from);
  const double ground = b * b - r2 + p_.bottomRadius_m * p_.bottomRadius_m;
  ray.hitsGround = b < 0.0 && ground > 0.0;
  ray.length = ray.hitsGround
                   ? std::max(-b - std::sqrt(ground), 0.0)
                   : -b + std::sqrt(std::max(b * b - r2 + p_.topRadius_m * p_.topRadius_m, 0.0));
  return ray;
}

BaselineReference::Ray BaselineReference::rayOf(const ProbeQuery& q, double azimuth) const {
  const Vec sun = {std::sin(q.sunZenith) * std::cos(azimuth),
                   std::sin(q.sunZenith) * std::sin(azimuth), std::cos(q.sunZenith)};
  return makeRay({0.0, 0.0, p_.bottomRadius_m + q.altitude_m},
                 {std::sin(q.zenith), 0.0, std::cos(q.zenith)}, sun);
}

Spectrum BaselineReference::sunlight(const Vec& at, const Vec& sun) const {
  const Ray ray = makeRay(at, sun, sun);
  if (ray.hitsGround) return {};
  Densities column;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) {
    const double u = (i + 0.5) / kSteps, dt = 2.0 * ray.length * u / kSteps;
    const Densities d = densities(altitude(along(at, sun, ray.length * u * u)));
    column.rayleigh += d.rayleigh * dt;
    column.mie += d.mie * dt;
    column.absorption += d.absorption * dt;
  }
  Spectrum light;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) light[c] = std::exp(-extinction(column, c));
  return light;
}

Spectrum BaselineReference::oneil(const ProbeQuery& query, int stepCount) const {
  const Ray ray = rayOf(query, query.azimuth);
  const double nu = dot(ray.direction, ray.sun), dt = ray.length / stepCount;
  Spectrum light, depth;
  for (int i = 0; i < stepCount; ++i) {
    const Vec at = along(ray.from, ray.direction, (i + 0.5) * dt);
    const Densities d = densities(altitude(at));
    const Spectrum sun = sunlight(at, ray.sun);
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      const double source =
          d.rayleigh * p_.rayleigh.scattering_per_m[c] * rayleighPhase(nu) +
          d.mie * p_.mie.scattering_per_m[c] * cornetteShanks(p_.mie.asymmetry, nu);
      const double half = 0.5 * dt * extinction(d, c);
      light[c] += dt * source * sun[c] * std::exp(-depth[c] - half);
      depth[c] += 2.0 * half;
    }
  }
  return light;
}

Spectrum BaselineReference::multiple(double h, double muS) const {
  const Vec from = {0.0, 0.0, p_.bottomRadius_m + h};
  const Vec sun = {std::sqrt(1.0 - muS * muS), 0.0, muS};
  Spectrum second, factor;
  for (int i = 0; i < 64; ++i) {
    const double z = 1.0 - (i / 8 + 0.5) / 4.0, phi = (i % 8 + 0.5) * kPi / 4.0;
    const double s = std::sqrt(1.0 - z * z);
    const Ray ray = makeRay(from, {s * std::cos(phi), s * std::sin(phi), z}, sun);
    const double dt = ray.length / 20.0;
    Spectrum transmittance = {{1.0, 1.0, 1.0}};
    for (int k = 0; k < 20; ++k) {
      const Vec at = along(from, ray.direction, (k + 0.5) * dt);
      const Densities d = densities(altitude(at));
      const Spectrum light = sunlight(at, sun);
      for (uint32_t c = 0; c < kSpectrumSize; ++c) {
        const double e = extinction(d, c);
        const double share = e > 0.0 ? (1.0 - std::exp(-e * dt)) / e : dt;
        second[c] += transmittance[c] * scattering(d, c) * light[c] / (4.0 * kPi) * share / 64.0;
        factor[c] += transmittance[c] * scattering(d, c) * share / 64.0;
        transmittance[c] *= std::exp(-e * dt);
      }
    }
    if (!ray.hitsGround) continue;
    const Vec at = along(from, ray.direction, ray.length);
    const double cosine = std::max(dot(at, sun) / length(at), 0.0);
    // The ground point itself is inside the sphere by rounding.
    const Spectrum light = sunlight(along(at, unit(at), 0.01), sun);
    for (uint32_t c = 0; c < kSpectrumSize; ++c)
      second[c] += transmittance[c] * p_.groundAlbedo[c] / kPi * cosine * light[c] / 64.0;
  }
  Spectrum psi;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) psi[c] = second[c] / (1.0 - factor[c]);
  return psi;
}

Spectrum BaselineReference::hillaire(const ProbeQuery& query, int stepCount) const {
  const Ray ray = rayOf(query, query.azimuth);
  const double nu = dot(ray.direction, ray.sun);
  Spectrum sum, transmittance = {{1.0, 1.0, 1.0}};
  for (int i = 0; i < stepCount; ++i) {
    const double from = ray.length * i * i / (stepCount * stepCount);
    const double to = ray.length * (i + 1) * (i + 1) / (stepCount * stepCount);
    const Vec at = along(ray.from, ray.direction, 0.5 * (from + to));
    const Densities d = densities(altitude(at));
    const Spectrum sun = sunlight(at, ray.sun);
    const Spectrum psi = multiple(altitude(at), dot(at, ray.sun) / length(at));
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      const double source =
          sun[c] * (d.rayleigh * p_.rayleigh.scattering_per_m[c] * rayleighPhase(nu) +
                    d.mie * p_.mie.scattering_per_m[c] * cornetteShanks(p_.mie.asymmetry, nu)) +
          psi[c] * scattering(d, c);
      const double depth = extinction(d, c) * (to - from);
      sum[c] += transmittance[c] * source * (1.0 - std::exp(-depth)) / extinction(d, c);
      transmittance[c] *= std::exp(-depth);
    }
  }
  return sum;
}

Spectrum BaselineReference::hoffmanPreetham(const ProbeQuery& query) const {
  const auto mass = [](double zenith) {
    const double t = std::min(zenith, 0.5 * kPi);
    return 1.0 / (std::cos(t) + 0.15 * std::pow(93.885 - t * 180.0 / kPi, -1.253));
  };
  const Ray ray = rayOf(query, query.azimuth);
  const double nu = dot(ray.direction, ray.sun);
  const bool whole = !query.bounded && !ray.hitsGround;
  const double d = !query.bounded ? ray.length : std::min(query.distance_m, ray.length);
  const double view = mass(query.zenith), sun = mass(query.sunZenith);
  Spectrum light;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    const double r = p_.rayleigh.scattering_per_m[c], m = p_.mie.scattering_per_m[c];
    const double e = p_.mie.extinction_per_m[c];
    const double lengthR = whole ? 8400.0 * view : d, lengthM = whole ? 1250.0 * view : d;
    const double depth = r * lengthR + e * lengthM;
    const double arriving = std::exp(-(r * 8400.0 + e * 1250.0) * sun);
    const double phases =
        r * lengthR * rayleighPhase(nu) + m * lengthM * henyeyGreenstein(p_.mie.asymmetry, nu);
    light[c] = phases / depth * arriving * (1.0 - std::exp(-depth));
  }
  return light;
}

Spectrum BaselineReference::schafhitzel(const ProbeQuery& query) const {
  const Ray ray = rayOf(query, 0.5 * kPi);
  const double nu = dot(ray.direction, rayOf(query, query.azimuth).sun);
  constexpr int kSteps = 1000;
  const double dt = ray.length / kSteps;
  Spectrum light, depth;
  for (int i = 0; i < kSteps; ++i) {
    const Vec at = along(ray.from, ray.direction, (i + 0.5) * dt);
    const Densities d = densities(altitude(at));
    const Spectrum sun = sunlight(at, ray.sun);
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      const double source =
          d.rayleigh * p_.rayleigh.scattering_per_m[c] * rayleighPhase(nu) +
          d.mie * p_.mie.scattering_per_m[c] * cornetteShanks(p_.mie.asymmetry, nu);
      const double half = 0.5 * dt * extinction(d, c);
      light[c] += dt * source * sun[c] * std::exp(-depth[c] - half);
      depth[c] += 2.0 * half;
    }
  }
  return light;
}

}  // namespace alpenglow::testing
