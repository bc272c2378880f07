#include "atmosphere/reference/ray_nodes.h"

#include "atmosphere/reference/rough_exp.h"

namespace alpenglow::reference {
namespace {

/// A length in which the light along a ray changes by a part of itself.
double scaleAt(const Medium& m, double h, double mu) {
  const double rayleigh =
      physics_f64::rayleighDensity(m, h) *
      std::max({m.rayleighScattering.x, m.rayleighScattering.y, m.rayleighScattering.z});
  const double mie = physics_f64::mieDensity(m, h) *
                     std::max({m.mieExtinction.x, m.mieExtinction.y, m.mieExtinction.z});
  const double gradient = rayleigh / m.rayleighScaleHeight + mie / m.mieScaleHeight;
  if (!(rayleigh + mie > 0.0) || !(gradient > 0.0)) return m.thickness;
  const double scaleHeight = (rayleigh + mie) / gradient;
  return std::min(physics_f64::distanceToGain(m, h, std::abs(mu), 0.3 * scaleHeight),
                  0.4 / (rayleigh + mie));
}

}  // namespace

RayNodes::RayNodes(const Medium& medium, const RaySegment& segment, double muS, double nu,
                   int intervals) {
  const auto& [h, mu, length] = segment;
  if (!(length > 0.0)) return;
  const double perigee = std::min(-physics_f64::radiusAt(medium, h) * mu, length);
  const double near = scaleAt(medium, h, mu);
  nodes_[0].t = 0.0;
  count_ = 1;
  if (!(perigee > 0.0)) {
    place(0.0, length, near, intervals + 4);
  } else {
    const double low = physics_f64::altitudeAt(medium, h, mu, perigee);
    const double lowMu = physics_f64::muAt(medium, h, mu, perigee, low);
    const double far = scaleAt(medium, low, lowMu);
    const double middle = perigee * near / (near + far);
    const int half = intervals * 3 / 4;
    place(0.0, middle, near, half);
    place(perigee, middle, far, half);
    if (length > perigee) place(perigee, length, far, intervals);
  }
  fill(medium, segment, muS, nu);
}

/// Adds the nodes after `from` up to `to`; with `from` beyond `to`, those from `to` up to `from`.
void RayNodes::place(double from, double to, double scale, int intervals) {
  const double length = std::abs(to - from);
  const double ratio = std::pow(1.0 + length / scale, 1.0 / intervals);
  const double uniform = length / intervals;
  double growth = ratio;
  for (int i = 1; i <= intervals; ++i, growth *= ratio) {
    // Steps of a short length are all alike, and the geometric formula would cancel.
    const double step =
        length < 1e-3 * scale ? i * uniform : std::min(scale * (growth - 1.0), length);
    // Counted from the far end when that is where steps are smallest.
    const int at = from < to ? count_ + i - 1 : count_ + intervals - 1 - i;
    if (from < to || i < intervals) {
      nodes_[static_cast<size_t>(at)].t = from < to ? from + step : from - step;
    }
  }
  count_ += intervals;
  nodes_[static_cast<size_t>(count_ - 1)].t = std::max(from, to);
}

void RayNodes::fill(const Medium& m, const RaySegment& segment, double muS, double nu) {
  const bool hasRayleigh =
      m.rayleighScattering.y > 0.0 || m.rayleighScattering.z > 0.0 || m.rayleighScattering.x > 0.0;
  const bool hasMie = m.mieExtinction.x > 0.0 || m.mieExtinction.y > 0.0 || m.mieExtinction.z > 0.0;
  const bool hasAbsorption = m.absorptionExtinction.x > 0.0 || m.absorptionExtinction.y > 0.0 ||
                             m.absorptionExtinction.z > 0.0;
  const double perRayleigh = 1.0 / m.rayleighScaleHeight, perMie = 1.0 / m.mieScaleHeight;
  physics_f64::Spectrum depth(0.0), before(0.0);
  for (int i = 0; i < count_; ++i) {
    RayNode& n = nodes_[static_cast<size_t>(i)];
    n.h = std::min(physics_f64::altitudeAt(m, segment.h, segment.mu, n.t), m.thickness);
    n.muS = physics_f64::muSAt(m, segment.h, muS, nu, n.t, n.h);
    n.rayleigh = hasRayleigh ? roughExp(-n.h * perRayleigh) : 0.0;
    n.mie = hasMie ? roughExp(-n.h * perMie) : 0.0;
    physics_f64::Spectrum extinction = m.rayleighScattering * n.rayleigh + m.mieExtinction * n.mie;
    if (hasAbsorption) extinction += physics_f64::tentExtinction(m, n.h);
    if (i > 0) {
      const double step = n.t - nodes_[static_cast<size_t>(i - 1)].t;
      depth += 0.5 * step * (before + extinction);
    }
    before = extinction;
    n.transmittance = roughExp(-depth);
  }
}

}  // namespace alpenglow::reference
