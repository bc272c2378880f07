// The standard solver's own text as C++ in double, reading tables that the device has baked: what
// each texel of the next table must be.
#pragma once

#include "atmosphere/model/physics_cpp.h"
#include "tests/bake/bake_fixture.h"

namespace alpenglow::solver_f64 {
using namespace physics_f64;             // NOLINT: as the text has it
using Spectrum = physics_f64::Spectrum;  // not the public one

/// Tables in double that the text below reads; set by the test before it calls the solver.
struct Source {
  uint32_t width = 0, height = 0, depth = 0;
  std::vector<double> values;  ///< Four a texel.

  Source() = default;
  explicit Source(const testing::CpuTable& table)
      : width(table.info.width),
        height(table.info.height),
        depth(table.info.depth),
        values(table.values.begin(), table.values.end()) {}
  Source(uint32_t w, uint32_t h, uint32_t d)
      : width(w), height(h), depth(d), values(size_t(4) * w * h * d) {}

  double* at(uint32_t x, uint32_t y, uint32_t z) {
    return &values[4 * ((size_t(z) * height + y) * width + x)];
  }
  /// Linear filtering with clamped edges, as the sampler does it.
  Real4 sample(Real u, Real v, Real w) const;
};

struct Sources {
  Source opticalDepth, deltaIrradiance, deltaRadiance, deltaMie, deltaSource, incident, incidentMie;
  bool firstOrder = false;
};
inline Sources sources;

inline Real4 Source::sample(Real u, Real v, Real w) const {
  const auto axis = [](Real coordinate, uint32_t size, uint32_t* lower, uint32_t* upper) {
    const Real x = glm::clamp(coordinate * size - 0.5, 0.0, size - 1.0);
    *lower = static_cast<uint32_t>(x);
    *upper = std::min(*lower + 1, size - 1);
    return x - *lower;
  };
  uint32_t x[2], y[2], z[2];
  const Real fx = axis(u, width, &x[0], &x[1]);
  const Real fy = axis(v, height, &y[0], &y[1]);
  const Real fz = axis(w, depth, &z[0], &z[1]);
  Real4 sum(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = (corner >> 1) & 1, k = corner >> 2;
    const Real weight = (i ? fx : 1.0 - fx) * (j ? fy : 1.0 - fy) * (k ? fz : 1.0 - fz);
    const double* t = &values[4 * ((size_t(z[k]) * height + y[j]) * width + x[i])];
    sum += weight * Real4(t[0], t[1], t[2], t[3]);
  }
  return sum;
}

inline Spectrum readTransmittance(Real2 uv) {
  return Spectrum(sources.opticalDepth.sample(uv[0], uv[1], 0.5));
}
inline Spectrum readDeltaIrradiance(Real2 uv) {
  return Spectrum(sources.deltaIrradiance.sample(uv[0], uv[1], 0.5));
}
inline Spectrum readDeltaRadiance(Real3 u) {
  return Spectrum(sources.deltaRadiance.sample(u[0], u[1], u[2]));
}
inline Spectrum readDeltaMie(Real3 u) {
  return Spectrum(sources.deltaMie.sample(u[0], u[1], u[2]));
}
inline Spectrum readDeltaSource(Real3 u) {
  return Spectrum(sources.deltaSource.sample(u[0], u[1], u[2]));
}
inline Spectrum readIncident(Real2 uv) {
  return Spectrum(sources.incident.sample(uv[0], uv[1], 0.5));
}
inline Spectrum readIncidentMie(Real2 uv) {
  return Spectrum(sources.incidentMie.sample(uv[0], uv[1], 0.5));
}

#define IN(type) const type&
#define OUT(type) type&
#define ALPENGLOW_FN inline
#define ALPENGLOW_PI 3.14159265358979323846
#define SPECTRUM(value) Spectrum(value)
#define REAL(literal) static_cast<double>(literal)
#define ALPENGLOW_TABLE_READS
#define ALPENGLOW_FIRST_ORDER sources.firstOrder
#include "shaders/glsl/physics/lookup.glsl"
#include "shaders/glsl/physics/standard.glsl"
#undef IN
#undef OUT
#undef ALPENGLOW_FN
#undef ALPENGLOW_PI
#undef SPECTRUM
#undef REAL
#undef ALPENGLOW_TABLE_READS
#undef ALPENGLOW_FIRST_ORDER

inline TableShape shapeOf(const TableSizes& s) {
  return {double(s.transmittanceMu), double(s.transmittanceR), double(s.irradianceMuS),
          double(s.irradianceR),     double(s.scatteringR),    double(s.scatteringMu),
          double(s.scatteringMuS),   double(s.scatteringNu)};
}

/// The ray of a texel of S, as shaders/glsl/bake/common.glsl has it.
struct Texel {
  Real h, mu, muS, nu;
  bool hitsGround;
  Real reach;
};
inline Texel texelOf(const Medium& m, const TableShape& shape, uint32_t x, uint32_t y, uint32_t z) {
  Texel t;
  const auto sizeMuS = static_cast<uint32_t>(shape.scatteringMuS);
  t.h = scatteringH(m, unitFromTexel(z, shape.scatteringR));
  t.hitsGround = y < shape.scatteringMu / 2;
  const Real uMu = scatteringUnitMuFromTexel(y, t.hitsGround, shape.scatteringMu);
  t.mu = scatteringMu(m, t.h, uMu, t.hitsGround);
  t.reach = scatteringReach(m, t.h, uMu, t.hitsGround);
  t.muS = scatteringMuS(unitFromTexel(x % sizeMuS, shape.scatteringMuS));
  t.nu = clampNu(t.mu, t.muS, 2.0 * unitFromTexel(x / sizeMuS, shape.scatteringNu) - 1.0);
  return t;
}

}  // namespace alpenglow::solver_f64
