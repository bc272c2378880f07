// The moment solver's lookups on the CPU in float, from copies of its tables: the code that the
// GPU runs, with sampling in place of the sampler.
#pragma once

#include "atmosphere/parameters/query.h"
#include "atmosphere/tables/moment_shape.h"

namespace alpenglow::cpu {
using namespace physics_f32;             // NOLINT: the shared source uses its names
using Spectrum = physics_f32::Spectrum;  // not the public one

/// A tightly packed copy of a table of RGBA16F or RGBA32F. Does not own it. Null data: zeros.
struct TableCopy {
  const void* data = nullptr;
  uint32_t width = 0, height = 0, depth = 0;
  bool half = false;

  Spectrum texel(uint32_t x, uint32_t y, uint32_t z) const;
  /// Linear filtering with clamped edges.
  Spectrum sample(Real u, Real v, Real w) const;
};

#define IN(type) const type&
#define OUT(type) type&
#define ALPENGLOW_FN inline
#define ALPENGLOW_PI 3.14159265358979323846
#define SPECTRUM(value) Spectrum(value)
#define REAL(literal) static_cast<float>(literal)

/// One atmosphere's tables, made without some effects (TableDesc::disabledEffects).
class Field {
 public:
  Field(const Medium& medium, const MomentShape& shape, EffectFlags disabledEffects,
        const TableCopy& opticalDepth, const TableCopy& moments, const TableCopy& source)
      : medium_(medium),
        shape_(shape),
        multiple_(hasEffect(disabledEffects, Effect::MultipleScattering)),
        irradiance_(multiple_ && hasEffect(disabledEffects, Effect::GroundIrradiance)),
        opticalDepth_(opticalDepth),
        moments_(moments),
        source_(source) {}

  /// Irradiance of the sun on a horizontal surface, and of the sky; h up to the top.
  Spectrum direct(Real h, Real muS) { return sunlight(medium_, shape_, h, muS) * max(muS, 0.0f); }
  Spectrum sky(Real h, Real muS) {
    return irradiance_ ? fieldIrradiance(medium_, shape_, h, muS) : Spectrum(0.0f);
  }
  Spectrum groundRadiance(Real muS) {
    return reflectedRadiance(medium_.groundAlbedo, direct(0.0f, muS), sky(0.0f, muS));
  }
  Spectrum transmittance(const Ray& ray, Real length) const {
    return exp(-opticalDepthOfSegment(medium_, ray.h, ray.mu, length));
  }
  Spectrum skyRadiance(const Ray& ray, Real length) {
    const int panels = static_cast<int>(shape_.viewPanels);
    return radianceOfPath(
        medium_, integrateInscattering(medium_, shape_, ray, length, panels, true, multiple_),
        ray.nu);
  }

 private:
  Spectrum readDepth(Real2 uv) const { return opticalDepth_.sample(uv[0], uv[1], 0.5f); }
  Spectrum readMoments(Real2 uv) const { return moments_.sample(uv[0], uv[1], 0.5f); }
  Spectrum readSource(Real3 uvw) const { return source_.sample(uvw[0], uvw[1], uvw[2]); }

#include "shaders/glsl/physics/field_lookup.glsl"
#include "shaders/glsl/physics/inscattering.glsl"

  Medium medium_;
  MomentShape shape_;
  bool multiple_, irradiance_;
  TableCopy opticalDepth_, moments_, source_;
};

#undef IN
#undef OUT
#undef ALPENGLOW_FN
#undef ALPENGLOW_PI
#undef SPECTRUM
#undef REAL

}  // namespace alpenglow::cpu
