// Single scattering along rays on the CPU, without a device and without a bake: the moment solver's
// own text in float (as the GPU has it) and in double, and the rays to try it with.
#pragma once

#include <alpenglow/probe.h>
#include <alpenglow/tables.h>

#include <vector>

#include "atmosphere/bake/moment_shape.h"
#include "atmosphere/model/query.h"

#define IN(type) const type&
#define OUT(type) type&
#define ALPENGLOW_FN inline
#define ALPENGLOW_PI 3.14159265358979323846
#define SPECTRUM(value) Spectrum(value)

namespace alpenglow::light_f32 {
using namespace physics_f32;             // NOLINT: as the text has it
using Spectrum = physics_f32::Spectrum;  // not the public one
#define REAL(literal) static_cast<float>(literal)
#include "tests/physics/direct_light.inc"
#undef REAL
}  // namespace alpenglow::light_f32

namespace alpenglow::light_f64 {
using namespace physics_f64;             // NOLINT: as the text has it
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

/// Both precisions of an atmosphere.
class BothLights {
 public:
  explicit BothLights(const Parameters& parameters, const MomentSettings& settings = {},
                      Quality quality = Quality::Default)
      : medium(makeMediumF64(parameters)),
        inDouble(medium, bake::makeMomentShapeF64(parameters, desc(parameters, settings, quality))),
        inFloat(makeMediumF32(parameters),
                bake::makeMomentShapeF32(parameters, desc(parameters, settings, quality))) {}

  physics_f64::Medium medium;
  light_f64::DirectLight inDouble;
  light_f32::DirectLight inFloat;

 private:
  static TableDesc desc(const Parameters& parameters, const MomentSettings& settings,
                        Quality quality) {
    TableDesc result;
    result.moments = momentSettings(parameters, quality, settings);
    return result;
  }
};

}  // namespace alpenglow::test
