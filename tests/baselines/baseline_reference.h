// The simpler models' formulas in double, written from their papers and not from the shaders'
// source.
#pragma once

#include <alpenglow/query.h>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {

/// A planet's air and rays in it.
class BaselineReference {
 public:
  explicit BaselineReference(const Parameters& parameters) : p_(parameters) {}

  Spectrum oneil(const ProbeQuery& query, int stepCount) const;
  /// Psi_ms at an altitude.
  Spectrum multiple(double h, double muS) const;
  Spectrum hillaire(const ProbeQuery& query, int stepCount) const;
  Spectrum hoffmanPreetham(const ProbeQuery& query) const;
  /// Single scattering of the whole ray as if the sun stood at a right angle to the view's azimuth,
  /// with the phase functions of its true place.
  Spectrum schafhitzel(const ProbeQuery& query) const;

 private:
  /// Relative densities of molecules, aerosols and the absorbing layer.
  struct Densities {
    double rayleigh = 0.0, mie = 0.0, absorption = 0.0;
  };
  struct Ray {
    Vec from, direction, sun;
    double length = 0.0;
    bool hitsGround = false;
  };
  Densities densities(double h) const;
  double altitude(const Vec& at) const { return length(at) - p_.bottomRadius_m; }
  double extinction(const Densities& d, uint32_t c) const;
  double scattering(const Densities& d, uint32_t c) const;
  Ray makeRay(const Vec& from, const Vec& direction, const Vec& sun) const;
  Ray rayOf(const ProbeQuery& query, double azimuth) const;
  /// Sunlight that arrives; zero in the planet's shadow.
  Spectrum sunlight(const Vec& at, const Vec& sun) const;

  Parameters p_;
};

}  // namespace alpenglow::testing
