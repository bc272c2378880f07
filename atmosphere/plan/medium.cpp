// Properties of a medium that the rules need.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/plan/rules.h"

namespace alpenglow::plan {
namespace {

constexpr double kPi = std::numbers::pi;

double greatest(const Spectrum& s) { return *std::max_element(s.value, s.value + kSpectrumSize); }

// Cornette-Shanks, 1 for light that is scattered evenly.
double phase(double g, double nu) {
  const double g2 = g * g;
  return 1.5 * (1.0 - g2) / (2.0 + g2) * (1.0 + nu * nu) / std::pow(1.0 + g2 - 2.0 * g * nu, 1.5);
}

double leastPhase(double g) {
  double least = phase(g, -1.0);
  for (int i = 0; i <= 64; ++i) least = std::min(least, phase(g, -1.0 + i / 32.0));
  return least;
}
double mostPhase(double g) { return std::max(phase(g, 1.0), phase(g, -1.0)); }

// Depth of a tangent ray at the ground through a density exp(-h / H), relative to the zenith's;
// twice, since light arrives along one such path and leaves along another.
double longestWay(double radius_m, double scaleHeight_m) {
  return 2.0 * std::max(1.0, std::sqrt(2.0 * kPi * radius_m / scaleHeight_m));
}

// Greatest ratio of the light of `a` to that of `b` at any altitude, by their scattering and phase.
double mostShare(const Spectrum& a, double heightA, double mostA, const Spectrum& b, double heightB,
                 double leastB, double thickness) {
  double most = 0.0;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    if (a[i] <= 0.0) continue;
    if (b[i] <= 0.0) return 1.0;
    // A ratio of exponentials: greatest at one of the ends.
    for (const double h : {0.0, thickness}) {
      const double ratio = a[i] * std::exp(-h / heightA) * mostA /
                           std::max(b[i] * std::exp(-h / heightB) * leastB, 1e-300);
      most = std::max(most, ratio);
    }
  }
  return std::min(most, 1.0);
}

}  // namespace

MediumTraits mediumTraits(const Parameters& p) {
  MediumTraits medium;
  const double thickness = p.topRadius_m - p.bottomRadius_m;
  const RayleighParameters& r = p.rayleigh;
  const MieParameters& m = p.mie;
  const AbsorptionParameters& a = p.absorption;
  medium.thickness_m = thickness;
  medium.dipOfTop = std::acos(p.bottomRadius_m / p.topRadius_m);
  medium.albedo = greatest(p.groundAlbedo);
  const double rDepth = r.present ? greatest(r.scattering_per_m) * r.scaleHeight_m : 0.0;
  const double mDepth = m.present ? greatest(m.extinction_per_m) * m.scaleHeight_m : 0.0;
  const double mScattering = m.present ? greatest(m.scattering_per_m) * m.scaleHeight_m : 0.0;
  const double aDepth = a.present ? greatest(a.extinction_per_m) * a.halfWidth_m : 0.0;
  medium.scattering = rDepth + mScattering;
  const double rWay = rDepth > 0.0 ? rDepth * longestWay(p.bottomRadius_m, r.scaleHeight_m) : 0.0;
  const double mWay = mDepth > 0.0 ? mDepth * longestWay(p.bottomRadius_m, m.scaleHeight_m) : 0.0;
  const double aWay = aDepth > 0.0 ? aDepth * longestWay(p.bottomRadius_m, a.halfWidth_m) : 0.0;
  medium.longest = rWay + mWay;
  medium.absorptionShare = std::min(1.0, aWay);
  const bool both = rDepth > 0.0 && mScattering > 0.0;
  medium.rayleighShare = rDepth > 0.0 ? 1.0 : 0.0;
  medium.mieShare = mDepth > 0.0 ? std::min(1.0, mScattering > 0.0 ? 1.0 : mWay) : 0.0;
  if (both) {
    const double mie = mostShare(m.scattering_per_m, m.scaleHeight_m, mostPhase(m.asymmetry),
                                 r.scattering_per_m, r.scaleHeight_m, 0.75, thickness);
    medium.mieShare = std::min(1.0, mie + mWay);
    const double molecules = mostShare(r.scattering_per_m, r.scaleHeight_m, 1.5, m.scattering_per_m,
                                       m.scaleHeight_m, leastPhase(m.asymmetry), thickness);
    medium.rayleighShare = std::min(1.0, molecules + rWay);
  }
  medium.peakAsymmetry = m.present ? std::abs(m.asymmetry) : 0.0;
  if (rDepth < 0.1 * medium.scattering)
    medium.peakAsymmetry = std::cbrt(medium.peakAsymmetry * medium.peakAsymmetry);
  const double height =
      std::max(r.present ? r.scaleHeight_m : 0.0, m.present ? m.scaleHeight_m : 0.0);
  medium.likeEarth = medium.dipOfTop < 8.5 * kDegree && height < 8500.0;
  return medium;
}

}  // namespace alpenglow::plan
