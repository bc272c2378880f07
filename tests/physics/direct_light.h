// Single scattering along rays on the CPU, without a device and without a bake: the moment solver's
// own text in float (as the GPU has it) and in double, and the rays to try it with.
#pragma once

#include <alpenglow/query.h>
#include <alpenglow/tables.h>

#include <vector>

#include "atmosphere/parameters/query.h"
#include "atmosphere/tables/moment_shape.h"
#include "atmosphere/tables/table_set.h"

#define IN(type) const type&
#define OUT(type) type&
#define ALPENGLOW_FN inline
#define ALPENGLOW_PI 3.14159265358979323846
#define SPECTRUM(value) Spectrum(value)

namespace alpenglow::light_f32 {
using namespace physics_f32;             // NOLINT: as the source has it
using Spectrum = physics_f32::Spectrum;  // not the public one
#define REAL(literal) static_cast<float>(literal)
#include "tests/physics/direct_light.inc"
#undef REAL
}  // namespace alpenglow::light_f32

namespace alpenglow::light_f64 {
using namespace physics_f64;             // NOLINT: as the source has it
using Spectrum = physics_f64::Spectrum;  // not the public one
#define REAL(literal) static_cast<double>(literal)
#include "tests/physics/direct_light.inc"
#undef REAL
}  // namespace alpenglow::light_f64

#undef IN
#undef OUT
#undef ALPENGLOW_FN
#undef ALPENGLOW_PI
#undef SPECTRUM

namespace alpenglow::test {

/// A ray as the program resolves it, in double and as the GPU gets it.
struct BothRays {
  physics_f64::Ray exact;
  physics_f32::Ray rounded;
  double length = 0.0;
};

inline BothRays bothRays(const physics_f64::Ray& exact, double length) {
  const auto f = [](double value) { return static_cast<float>(value); };
  return {exact,
          {f(exact.start), f(exact.h), f(exact.mu), f(exact.muS), f(exact.nu), f(exact.extent),
           exact.hitsGround, exact.inAtmosphere},
          length};
}

/// Finite, not negative, transmittance in [0, 1].
inline bool isSound(const light_f32::DirectLight::Light& light) {
  for (int c = 0; c < 3; ++c) {
    const float t = light.transmittance[c], scattered[] = {light.rayleigh[c], light.mie[c]};
    if (!(t >= 0.0f && t <= 1.0f)) return false;
    for (float s : scattered)
      if (!(s >= 0.0f && std::isfinite(s))) return false;
  }
  return true;
}

/// Along a ray the light that is scattered towards its beginning without phase functions, the
/// integral of T beta_s T_sun, is at most the integral of T (beta_s + beta_a), which is 1 - T: no
/// more can be scattered out of a beam than it loses. So their sum is at most what comes in, 1.
inline bool isBalanced(const light_f32::DirectLight::Light& light) {
  for (int c = 0; c < 3; ++c)
    if (!(light.transmittance[c] + light.rayleigh[c] + light.mie[c] <= 1.02f)) return false;
  return true;
}

inline TableDesc tableDesc(const Parameters& parameters, const TableSizes& settings) {
  TableDesc desc;
  desc.sizes = settings;
  return tables::completed(parameters, desc);
}

inline light_f64::DirectLight lightsInDouble(const Parameters& p, const TableSizes& settings = {}) {
  return {makeMediumF64(p), tables::makeMomentShapeF64(p, tableDesc(p, settings))};
}

inline light_f32::DirectLight lightsInFloat(const Parameters& p, const TableSizes& settings = {}) {
  return {makeMediumF32(p), tables::makeMomentShapeF32(p, tableDesc(p, settings))};
}

/// Both precisions of an atmosphere, as the default quality has it.
struct BothLights {
  explicit BothLights(const Parameters& p)
      : medium(makeMediumF64(p)), inDouble(lightsInDouble(p)), inFloat(lightsInFloat(p)) {}

  physics_f64::Medium medium;
  light_f64::DirectLight inDouble;
  light_f32::DirectLight inFloat;
};

}  // namespace alpenglow::test
