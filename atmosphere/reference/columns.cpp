#include "atmosphere/reference/columns.h"

#include <algorithm>
#include <array>

#include "atmosphere/reference/quadrature.h"

namespace alpenglow::reference {
namespace {

/// The Chapman function: the column over the scale height, for unit density at r.
double chapman(double r, double mu, double scaleHeight) {
  // Distances at which the ray has gained these many scale heights; beyond 45, e^-45 is nothing.
  std::vector<double> breaks = {0.0};
  for (double heights : {0.3, 1.0, 2.5, 5.0, 10.0, 20.0, 45.0}) {
    const double gain = heights * scaleHeight;
    const double square = gain * (2.0 * r + gain);
    breaks.push_back(square / (r * mu + std::sqrt(r * r * mu * mu + square)));
  }
  const auto density = [&](double t) {
    const double square = t * (t + 2.0 * r * mu);
    const double gain = square / (std::sqrt(r * r + square) + r);
    return std::array<double, 1>{std::exp(-gain / scaleHeight)};
  };
  return integrate<1>(density, breaks, {1e-11, 0.0}).value[0] / scaleHeight;
}

/// Weights of the cubic through nodes -1, 0, 1, 2 at x in [0, 1]; the stencil's first node.
struct Stencil {
  int first;
  std::array<double, 4> weights;
};

Stencil stencilAt(double position, int nodes) {
  const int first = std::clamp(static_cast<int>(position) - 1, 0, nodes - 4);
  const double x = position - first - 1;
  const double a = x + 1.0, b = x, c = x - 1.0, d = x - 2.0;
  return {first, {-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0}};
}

bool isPresent(const physics_f64::Spectrum& extinction) {
  return extinction.x > 0.0 || extinction.y > 0.0 || extinction.z > 0.0;
}

}  // namespace

ChapmanTable::ChapmanTable(double bottomRadius, double thickness, double scaleHeight)
    : bottomRadius_(bottomRadius),
      scaleHeight_(scaleHeight),
      radiusScale_((kRadii - 1) / std::log1p(thickness / bottomRadius)),
      values_(static_cast<size_t>(kRadii) * kCosines) {
  for (int i = 0; i < kRadii; ++i) {
    const double r = bottomRadius * std::exp(i / radiusScale_);
    const double root = std::sqrt(r / scaleHeight);
    for (int j = 0; j < kCosines; ++j) {
      const double mu = std::min(std::sinh(std::asinh(root) * j / (kCosines - 1)) / root, 1.0);
      values_[static_cast<size_t>(i * kCosines + j)] = 1.0 / chapman(r, mu, scaleHeight);
    }
  }
}

double ChapmanTable::column(double h, double mu) const {
  const double root = std::sqrt((bottomRadius_ + h) / scaleHeight_);
  const double x = root * std::min(mu, 1.0);
  // asinh for x >= 0, in the form that compilers have fast logarithms for.
  const double q = std::log(x + std::sqrt(x * x + 1.0));
  const double end = std::log(root + std::sqrt(root * root + 1.0));
  const Stencil radii = stencilAt(std::log1p(h / bottomRadius_) * radiusScale_, kRadii);
  const Stencil cosines = stencilAt(q / end * (kCosines - 1), kCosines);
  const double* row = &values_[static_cast<size_t>(radii.first * kCosines + cosines.first)];
  double value = 0.0;
  for (size_t i = 0; i < 4; ++i, row += kCosines) {
    double sum = 0.0;
    for (size_t j = 0; j < 4; ++j) sum += cosines.weights[j] * row[j];
    value += radii.weights[i] * sum;
  }
  return scaleHeight_ * std::exp(-h / scaleHeight_) / value;
}

Columns::Columns(const Medium& medium)
    : medium_(medium),
      hasRayleigh_(isPresent(medium.rayleighScattering)),
      hasMie_(isPresent(medium.mieExtinction)),
      hasAbsorption_(isPresent(medium.absorptionExtinction)) {
  if (hasRayleigh_) {
    rayleigh_ = ChapmanTable(medium.bottomRadius, medium.thickness, medium.rayleighScaleHeight);
  }
  if (hasMie_) mie_ = ChapmanTable(medium.bottomRadius, medium.thickness, medium.mieScaleHeight);
}

Column Columns::upwards(double h, double mu) const {
  return {hasRayleigh_ ? rayleigh_.column(h, mu) : 0.0, hasMie_ ? mie_.column(h, mu) : 0.0,
          hasAbsorption_ ? absorptionUpwards(h, mu) : 0.0};
}

/// The tent is linear in r, and the integral of r = sqrt(s^2 + b^2) is (s r + b^2 ln(s + r)) / 2.
double Columns::absorptionUpwards(double h, double mu) const {
  const double center = medium_.absorptionCenter, half = medium_.absorptionHalfWidth;
  const double r = medium_.bottomRadius + h;
  const double s0 = r * mu;
  const double b2 = r * r * (1.0 - mu) * (1.0 + mu);
  const auto edge = [&](double altitude) { return std::clamp(altitude, h, medium_.thickness); };
  const double edges[3] = {edge(center - half), edge(center), edge(center + half)};
  double sum = 0.0, sBefore = 0.0, areaBefore = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double z = edges[i];
    const double rz = medium_.bottomRadius + z;
    const double s =
        std::sqrt(std::max(s0 * s0 + (z - h) * (2.0 * medium_.bottomRadius + z + h), 0.0));
    const double area = 0.5 * (s * rz + b2 * std::log(s + rz));
    if (i > 0 && z > edges[i - 1]) {
      const double slope = (i == 1 ? 1.0 : -1.0) / half;
      const double atCenter = 1.0 - slope * (medium_.bottomRadius + center);
      sum += atCenter * (s - sBefore) + slope * (area - areaBefore);
    }
    sBefore = s;
    areaBefore = area;
  }
  return std::max(sum, 0.0);
}

Column Columns::toTop(double h, double mu) const {
  mu = std::max(mu, physics_f64::horizonMu(medium_, h));
  const double rMu = physics_f64::radiusAt(medium_, h) * mu;
  const double top = physics_f64::topRadius(medium_);
  const double topMu = std::sqrt(rMu * rMu + physics_f64::topGapSquared(medium_, h)) / top;
  Column beyond = upwards(medium_.thickness, std::min(topMu, 1.0));
  beyond.absorption = 0.0;
  if (mu >= 0.0) return upwards(h, mu) - beyond;
  const double sine = std::sqrt((1.0 - mu) * (1.0 + mu));
  const double lowest =
      std::max(h - physics_f64::radiusAt(medium_, h) * mu * mu / (1.0 + sine), 0.0);
  const Column half = upwards(lowest, 0.0);
  return half + half - upwards(h, -mu) - beyond;
}

Column Columns::between(double h0, double mu0, const Column& start, double h1, double mu1) const {
  const Column end = upwards(h1, std::abs(mu1));
  if (mu0 >= 0.0) return start - end;
  if (mu1 <= 0.0) return end - start;
  const double sine = std::sqrt((1.0 - mu0) * (1.0 + mu0));
  const double lowest =
      std::max(h0 - physics_f64::radiusAt(medium_, h0) * mu0 * mu0 / (1.0 + sine), 0.0);
  const Column half = upwards(lowest, 0.0);
  return half + half - start - end;
}

physics_f64::Spectrum Columns::depth(const Column& column) const {
  return medium_.rayleighScattering * std::max(column.rayleigh, 0.0) +
         medium_.mieExtinction * std::max(column.mie, 0.0) +
         medium_.absorptionExtinction * std::max(column.absorption, 0.0);
}

}  // namespace alpenglow::reference
