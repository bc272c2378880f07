#include "atmosphere/reference/optical_depth.h"

namespace alpenglow::reference {
namespace {

/// The integrand: extinction at distance t, as the quadrature wants it.
auto extinctionAlong(const Medium& medium, const Stretch& stretch) {
  return [&medium, stretch](double t) {
    const double h = physics_f64::altitudeAt(medium, stretch.h, stretch.mu, t);
    const physics_f64::Spectrum value = physics_f64::extinction(medium, h);
    std::array<double, kSpectrumSize> result;
    for (uint32_t i = 0; i < kSpectrumSize; ++i) {
      result[i] = value[static_cast<glm::length_t>(i)];
    }
    return result;
  };
}

/// Where a ray passes altitudes: distances from its perigee, which may lie below the ground.
class Crossings {
 public:
  Crossings(const Medium& medium, const Stretch& stretch)
      : bottomRadius_(medium.bottomRadius), perigee_(-(bottomRadius_ + stretch.h) * stretch.mu) {
    const double mu2 = std::min(stretch.mu * stretch.mu, 1.0);
    perigeeAltitude_ = stretch.h - (bottomRadius_ + stretch.h) * mu2 / (1.0 + std::sqrt(1.0 - mu2));
  }
  double perigee() const { return perigee_; }
  double perigeeAltitude() const { return perigeeAltitude_; }
  void addAltitude(double altitude, std::vector<double>& pieces) const {
    const double square =
        (altitude - perigeeAltitude_) * (2.0 * bottomRadius_ + altitude + perigeeAltitude_);
    if (square > 0.0) {
      pieces.push_back(perigee_ - std::sqrt(square));
      pieces.push_back(perigee_ + std::sqrt(square));
    }
  }

 private:
  double bottomRadius_;
  double perigee_;
  double perigeeAltitude_ = 0.0;
};

}  // namespace

void tidyPieces(std::vector<double>& pieces, double length) {
  pieces.push_back(0.0);
  pieces.push_back(length);
  const double least = 1e-12 * length;
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(),
                              [=](double t) {
                                const bool end = t == 0.0 || t == length;
                                return !end && !(t > least && t < length - least);
                              }),
               pieces.end());
  std::sort(pieces.begin(), pieces.end());
  pieces.erase(std::unique(pieces.begin(), pieces.end(),
                           [=](double a, double b) { return b - a <= least && b != length; }),
               pieces.end());
}

std::vector<double> smoothPieces(const Medium& medium, const Stretch& stretch) {
  const Crossings crossings(medium, stretch);
  const bool perigeeAhead = crossings.perigee() > 0.0 && crossings.perigee() < stretch.length;
  const double end = physics_f64::altitudeAt(medium, stretch.h, stretch.mu, stretch.length);
  const double lowest =
      std::max(perigeeAhead ? crossings.perigeeAltitude() : std::min(stretch.h, end), 0.0);

  std::vector<double> pieces;
  pieces.reserve(40);
  pieces.push_back(crossings.perigee());
  for (double side : {-1.0, 0.0, 1.0}) {
    crossings.addAltitude(medium.absorptionCenter + side * medium.absorptionHalfWidth, pieces);
  }
  for (double scaleHeight : {medium.rayleighScaleHeight, medium.mieScaleHeight}) {
    for (double heights : {1.0, 4.0, 16.0, 64.0}) {
      crossings.addAltitude(lowest + heights * scaleHeight, pieces);
    }
  }
  tidyPieces(pieces, stretch.length);
  return pieces;
}

SpectrumIntegral opticalDepthBetween(const Medium& medium, const Stretch& stretch, double t0,
                                     double t1, const Tolerance& tolerance) {
  return integrate<kSpectrumSize>(extinctionAlong(medium, stretch), {t0, t1}, tolerance);
}

SpectrumIntegral opticalDepth(const Medium& medium, const Stretch& stretch,
                              const Tolerance& tolerance) {
  if (!(stretch.length > 0.0)) {
    return {};
  }
  return integrate<kSpectrumSize>(extinctionAlong(medium, stretch), smoothPieces(medium, stretch),
                                  tolerance);
}

SpectrumIntegral opticalDepthToTop(const Medium& medium, double h, double mu,
                                   const Tolerance& tolerance) {
  const double clamped = std::max(mu, physics_f64::horizonMu(medium, h));
  return opticalDepth(medium, {h, clamped, physics_f64::distanceToTop(medium, h, clamped)},
                      tolerance);
}

}  // namespace alpenglow::reference
