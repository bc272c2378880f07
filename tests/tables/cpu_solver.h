// The standard solver's own text as C++ in double, reading tables that the device has baked: what
// each texel of the next table must be.
#pragma once

#include "tests/tables/cpu_table.h"

namespace alpenglow::solver_f64 {
using namespace physics_f64;             // NOLINT: as the source has it
using Spectrum = physics_f64::Spectrum;  // not the public one

using Source = testing::DoubleTable;

/// What the code below reads; set by the test before it calls the solver.
struct Sources {
  Source opticalDepth, deltaIrradiance, deltaRadiance, deltaMie, deltaSource, incident, incidentMie;
  bool firstOrder = false;
};
inline Sources sources;

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

/// The ray of a texel of S, as shaders/glsl/tables/common.glsl has it.
struct Texel {
  Real h, mu, muS, nu;
  bool hitsGround;
  Real reach;
};
inline Texel texelOf(const Medium& m, const TableShape& shape, uint32_t x, uint32_t y, uint32_t z) {
  Texel t;
  const auto sizeMuS = static_cast<uint32_t>(shape.scatteringMuS);
  t.h = scatteringH(m, texelToU(z, shape.scatteringR));
  t.hitsGround = y < shape.scatteringMu / 2;
  const Real uMu = texelToScatteringUmu(y, t.hitsGround, shape.scatteringMu);
  t.mu = scatteringMu(m, t.h, uMu, t.hitsGround);
  t.reach = scatteringReach(m, t.h, uMu, t.hitsGround);
  t.muS = scatteringMuS(texelToU(x % sizeMuS, shape.scatteringMuS));
  t.nu = clampNu(t.mu, t.muS, 2.0 * texelToU(x / sizeMuS, shape.scatteringNu) - 1.0);
  return t;
}

}  // namespace alpenglow::solver_f64
