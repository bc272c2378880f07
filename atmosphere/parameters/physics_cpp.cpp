#include "atmosphere/parameters/physics_cpp.h"

#include <algorithm>

namespace alpenglow {
namespace {

template <class M, class Real>
M makeMedium(const Parameters& p) {
  using Vector = decltype(M::rayleighScattering);
  auto spectrum = [](const Spectrum& s) {
    Vector v;
    for (uint32_t i = 0; i < kSpectrumSize; ++i)
      v[static_cast<glm::length_t>(i)] = static_cast<Real>(s[i]);
    return v;
  };
  M m{};
  // An absent constituent must not have the smaller scale height, by which rays are split.
  m.rayleighScaleHeight = m.mieScaleHeight = static_cast<Real>(p.topRadius_m - p.bottomRadius_m);
  m.absorptionHalfWidth = Real(1);
  if (p.rayleigh.present) {
    m.rayleighScattering = spectrum(p.rayleigh.scattering_per_m);
    m.rayleighScaleHeight = static_cast<Real>(p.rayleigh.scaleHeight_m);
  }
  if (p.mie.present) {
    m.mieScattering = spectrum(p.mie.scattering_per_m);
    m.mieExtinction = spectrum(p.mie.extinction_per_m);
    m.mieScaleHeight = static_cast<Real>(p.mie.scaleHeight_m);
    m.mieAsymmetry = static_cast<Real>(p.mie.asymmetry);
  }
  if (p.absorption.present) {
    m.absorptionExtinction = spectrum(p.absorption.extinction_per_m);
    m.absorptionCenter = static_cast<Real>(p.absorption.center_m);
    m.absorptionHalfWidth = static_cast<Real>(p.absorption.halfWidth_m);
  }
  m.groundAlbedo = spectrum(p.groundAlbedo);
  const double thickness = p.topRadius_m - p.bottomRadius_m;
  const double topRho = std::sqrt(thickness * (p.bottomRadius_m + p.topRadius_m));
  m.bottomRadius = static_cast<Real>(p.bottomRadius_m);
  m.thickness = static_cast<Real>(thickness);
  m.topRho = static_cast<Real>(topRho);
  // -0.15 holds Earth's horizon from the top (-0.136); smaller planets see further round.
  m.transmittanceMuMin = static_cast<Real>(std::min(-0.15, -topRho / p.topRadius_m));
  m.sunSinRadius = static_cast<Real>(std::sin(p.sunAngularRadius));
  return m;
}

}  // namespace

physics_f64::Medium makeMediumF64(const Parameters& parameters) {
  return makeMedium<physics_f64::Medium, double>(parameters);
}

physics_f32::Medium makeMediumF32(const Parameters& parameters) {
  return makeMedium<physics_f32::Medium, float>(parameters);
}

}  // namespace alpenglow
