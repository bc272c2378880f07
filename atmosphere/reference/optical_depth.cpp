#include "atmosphere/reference/optical_depth.h"

namespace alpenglow::reference {
namespace {

/// The integrand: extinction at distance t, as the quadrature wants it.
auto extinctionAlong(const Medium& medium, const RaySegment& segment) {
  return [&medium, segment](double t) {
    const double h = physics_f64::altitudeAt(medium, segment.h, segment.mu, t);
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
  Crossings(const Medium& medium, const RaySegment& segment)
      : bottomRadius_(medium.bottomRadius), perigee_(-(bottomRadius_ + segment.h) * segment.mu) {
    const double mu2 = std::min(segment.mu * segment.mu, 1.0);
    perigeeAltitude_ = segment.h - (bottomRadius_ + segment.h) * mu2 / (1.0 + std::sqrt(1.0 - mu2));
  }
  double perigee() const { return perigee_; }
  double perigeeAltitude() const { return perigeeAltitude_; }
  void addAltitude(double altitude, std::vector<double>& breaks) const {
    const double square =
        (altitude - perigeeAltitude_) * (2.0 * bottomRadius_ + altitude + perigeeAltitude_);
    if (square > 0.0) {
      breaks.push_back(perigee_ - std::sqrt(square));
      breaks.push_back(perigee_ + std::sqrt(square));
    }
  }

 private:
  double bottomRadius_;
  double perigee_;
  double perigeeAltitude_ = 0.0;
};

}  // namespace

void tidyBreaks(std::vector<double>& breaks, double length) {
  breaks.push_back(0.0);
  breaks.push_back(length);
  const double least = 1e-12 * length;
  breaks.erase(std::remove_if(breaks.begin(), breaks.end(),
                              [=](double t) {
                                const bool end = t == 0.0 || t == length;
                                return !end && !(t > least && t < length - least);
                              }),
               breaks.end());
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end(),
                           [=](double a, double b) { return b - a <= least && b != length; }),
               breaks.end());
}

std::vector<double> smoothBreaks(const Medium& medium, const RaySegment& segment) {
  const Crossings crossings(medium, segment);
  const bool perigeeAhead = crossings.perigee() > 0.0 && crossings.perigee() < segment.length;
  const double end = physics_f64::altitudeAt(medium, segment.h, segment.mu, segment.length);
  const double lowest =
      std::max(perigeeAhead ? crossings.perigeeAltitude() : std::min(segment.h, end), 0.0);

  std::vector<double> breaks;
  breaks.reserve(40);
  breaks.push_back(crossings.perigee());
  for (double side : {-1.0, 0.0, 1.0}) {
    crossings.addAltitude(medium.absorptionCenter + side * medium.absorptionHalfWidth, breaks);
  }
  for (double scaleHeight : {medium.rayleighScaleHeight, medium.mieScaleHeight}) {
    for (double heights : {1.0, 4.0, 16.0, 64.0}) {
      crossings.addAltitude(lowest + heights * scaleHeight, breaks);
    }
  }
  tidyBreaks(breaks, segment.length);
  return breaks;
}

SpectrumIntegral opticalDepthBetween(const Medium& medium, const RaySegment& segment, double t0,
                                     double t1, const Tolerance& tolerance) {
  return integrate<kSpectrumSize>(extinctionAlong(medium, segment), {t0, t1}, tolerance);
}

SpectrumIntegral opticalDepth(const Medium& medium, const RaySegment& segment,
                              const Tolerance& tolerance) {
  if (!(segment.length > 0.0)) {
    return {};
  }
  return integrate<kSpectrumSize>(extinctionAlong(medium, segment), smoothBreaks(medium, segment),
                                  tolerance);
}

SpectrumIntegral opticalDepthToTop(const Medium& medium, double h, double mu,
                                   const Tolerance& tolerance) {
  const double clamped = std::max(mu, physics_f64::horizonMu(medium, h));
  return opticalDepth(medium, {h, clamped, physics_f64::distanceToTop(medium, h, clamped)},
                      tolerance);
}

}  // namespace alpenglow::reference
