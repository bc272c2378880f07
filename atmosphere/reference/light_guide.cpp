#include "atmosphere/reference/light_guide.h"

#include <algorithm>
#include <numbers>

#include "atmosphere/reference/ray_nodes.h"

namespace alpenglow::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;
/// Sun angles crowd where twilight changes fastest: theta = 95 + 10 sinh(f) degrees.
constexpr double kTwilight = 95.0 * kDegree;
constexpr double kSpread = 10.0 * kDegree;
/// Successive orders; the orders beyond have the shape of the last.
constexpr int kIterations = 4;
/// Least share of a cell of directions: the rough solution may be wrong about any.
constexpr float kDefence = 0.05f;

}  // namespace

DirectionGrid::Angles DirectionGrid::rowEnds(int row, double horizon) {
  const bool sky = row < kSkyRows;
  const double count = sky ? kSkyRows : kGroundRows;
  const double y0 = (sky ? row : row - kSkyRows) / count, y1 = y0 + 1.0 / count;
  const double range = sky ? 1.0 - horizon : -1.0 - horizon;
  return {horizon + range * y0 * y0, horizon + range * y1 * y1};
}

DirectionGrid::Angles DirectionGrid::sample(double u, double v, double w) const {
  const float* cell = std::upper_bound(sums_, sums_ + kCells - 1, static_cast<float>(u));
  const auto k = static_cast<int>(cell - sums_);
  const Angles ends = rowEnds(k / kColumns, horizon_);
  // One number gives the place in the column and the side of the sun.
  const double side = w < 0.5 ? 1.0 : -1.0;
  const double across = w < 0.5 ? 2.0 * w : 2.0 * w - 1.0;
  return {ends.mu + v * (ends.phi - ends.mu), side * (k % kColumns + across) * kPi / kColumns};
}

double DirectionGrid::density(double mu, double cosPhi) const {
  const bool sky = mu >= horizon_;
  const double range = sky ? 1.0 - horizon_ : 1.0 + horizon_;
  const double y = std::sqrt(std::min(std::abs(mu - horizon_) / std::max(range, 1e-12), 1.0));
  const int count = sky ? kSkyRows : kGroundRows;
  const int row = std::min(static_cast<int>(y * count), count - 1) + (sky ? 0 : kSkyRows);
  const double phi = std::acos(std::clamp(cosPhi, -1.0, 1.0));
  const int column = std::min(static_cast<int>(phi * (kColumns / kPi)), kColumns - 1);
  const int k = row * kColumns + column;
  const double probability = k > 0 ? sums_[k] - sums_[k - 1] : sums_[0];
  const Angles ends = rowEnds(row, horizon_);
  // The cell and its twin on the other side of the sun.
  return probability / (std::abs(ends.phi - ends.mu) * 2.0 * kPi / kColumns);
}

LightGuide::LightGuide(const Medium& medium, const Columns& columns)
    : medium_(medium),
      nodes_(static_cast<size_t>(kAltitudes) * kSuns),
      cells_(nodes_.size() * DirectionGrid::kCells),
      sunPosition_(kLookup + 2) {
  const double first = std::asinh((0.0 - kTwilight) / kSpread);
  const double last = std::asinh((kPi - kTwilight) / kSpread);
  for (int i = 0; i < kLookup + 2; ++i) {
    const double angle = std::acos(std::clamp(2.0 * i / kLookup - 1.0, -1.0, 1.0));
    const double f = (std::asinh((angle - kTwilight) / kSpread) - first) / (last - first);
    sunPosition_[static_cast<size_t>(i)] = static_cast<float>(f * (kSuns - 1));
  }
  for (int i = 0; i < kAltitudes; ++i) {
    for (int j = 0; j < kSuns; ++j) {
      const double h = altitudeOf(i), muS = std::cos(sunAngleOf(j));
      const double visible = physics_f64::sunVisibility(medium, h, muS);
      const physics_f64::Spectrum light = visible * exp(-columns.depth(columns.toTop(h, muS)));
      for (int c = 0; c < 3; ++c) {
        nodes_[static_cast<size_t>(i * kSuns + j)].values[3 + c] = static_cast<float>(light[c]);
      }
    }
  }
  for (int i = 0; i < kIterations; ++i) iterate();
}

double LightGuide::altitudeOf(int i) const {
  const double x = static_cast<double>(i) / (kAltitudes - 1);
  return medium_.thickness * x * x;
}

double LightGuide::sunAngleOf(int j) {
  const double first = std::asinh((0.0 - kTwilight) / kSpread);
  const double last = std::asinh((kPi - kTwilight) / kSpread);
  const double x = static_cast<double>(j) / (kSuns - 1);
  return std::clamp(kTwilight + kSpread * std::sinh(first + (last - first) * x), 0.0, kPi);
}

double LightGuide::altitudePosition(double h) const {
  return std::sqrt(std::clamp(h / medium_.thickness, 0.0, 1.0)) * (kAltitudes - 1);
}

float LightGuide::sunPosition(double muS) const {
  const double place = (muS + 1.0) * (0.5 * kLookup);
  const int k = static_cast<int>(place);
  const float* lookup = &sunPosition_[static_cast<size_t>(k)];
  return std::clamp(lookup[0] + static_cast<float>(place - k) * (lookup[1] - lookup[0]), 0.0f,
                    static_cast<float>(kSuns - 1));
}

GuideLight LightGuide::at(double h, double muS) const {
  const double y = altitudePosition(h);
  const float x = sunPosition(muS);
  const int i = std::min(static_cast<int>(y), kAltitudes - 2);
  const int j = std::min(static_cast<int>(x), kSuns - 2);
  const float fy = static_cast<float>(y - i), fx = x - static_cast<float>(j);
  const Node* low = &nodes_[static_cast<size_t>(i * kSuns + j)];
  const Node* high = low + kSuns;
  const float w00 = (1 - fy) * (1 - fx), w01 = (1 - fy) * fx, w10 = fy * (1 - fx), w11 = fy * fx;
  float v[kValues];
  for (int c = 0; c < kValues; ++c) {
    v[c] = w00 * low[0].values[c] + w01 * low[1].values[c] + w10 * high[0].values[c] +
           w11 * high[1].values[c];
  }
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

DirectionGrid LightGuide::directionsAt(double h, double muS) const {
  const int i = static_cast<int>(altitudePosition(h) + 0.5);
  const int j = static_cast<int>(sunPosition(muS) + 0.5f);
  const auto node = static_cast<size_t>(i * kSuns + j);
  return {&cells_[node * DirectionGrid::kCells], physics_f64::horizonMu(medium_, h)};
}

void LightGuide::iterate() {
  std::vector<Node> next(nodes_.size());
  for (int i = 0; i < kAltitudes; ++i) {
    for (int j = 0; j < kSuns; ++j) {
      const auto k = static_cast<size_t>(i * kSuns + j);
      next[k] = gather(altitudeOf(i), sunAngleOf(j), &cells_[k * DirectionGrid::kCells]);
      for (int c = 3; c < 6; ++c) next[k].values[c] = nodes_[k].values[c];
    }
  }
  nodes_.swap(next);
}

/// The mean of the light that the present solution sends to a point, and how it is spread.
LightGuide::Node LightGuide::gather(double h, double sunAngle, float* cells) const {
  using Grid = DirectionGrid;
  const double muS = std::cos(sunAngle), sunSine = std::sin(sunAngle);
  physics_f64::Spectrum sum(0.0);
  double total = 0.0;
  std::array<double, Grid::kCells> weights;
  for (int row = 0; row < Grid::kSkyRows + Grid::kGroundRows; ++row) {
    const Grid::Angles ends = Grid::rowEnds(row, physics_f64::horizonMu(medium_, h));
    const double mu = 0.5 * (ends.mu + ends.phi);
    const double share = 0.5 * std::abs(ends.phi - ends.mu) / Grid::kColumns;  // Of the sphere.
    const double sine = std::sqrt(std::max(1.0 - mu * mu, 0.0));
    for (int column = 0; column < Grid::kColumns; ++column) {
      const double cosine = std::cos((column + 0.5) * kPi / Grid::kColumns);
      const double nu = std::clamp(mu * muS + sine * sunSine * cosine, -1.0, 1.0);
      const physics_f64::Spectrum light = share * radiance(h, mu, muS, nu);
      sum += light;
      double& weight = weights[static_cast<size_t>(row * Grid::kColumns + column)];
      weight = light.x + light.y + light.z;
      total += weight;
    }
  }
  float running = 0.0f;
  for (size_t k = 0; k < Grid::kCells; ++k) {
    const float share = total > 0.0 ? static_cast<float>(weights[k] / total) : 1.0f / Grid::kCells;
    running += (1.0f - kDefence) * share + kDefence / Grid::kCells;
    cells[k] = running;
  }
  for (size_t k = 0; k < Grid::kCells; ++k) cells[k] /= running;
  Node node;
  for (int c = 0; c < 3; ++c) node.values[c] = static_cast<float>(sum[c]);
  return node;
}

/// Equations 10 and 11 of the paper with isotropic scattering of the light that scattered before.
physics_f64::Spectrum LightGuide::radiance(double h, double mu, double muS, double nu) const {
  const bool ground = physics_f64::rayHitsGround(medium_, h, mu);
  const double length = ground ? physics_f64::distanceToGround(medium_, h, mu)
                               : physics_f64::distanceToTop(medium_, h, mu);
  RayNodes nodes(medium_, {h, mu, length}, muS, nu, RayNodes::kCoarse);
  const physics_f64::Spectrum rayleigh =
      medium_.rayleighScattering * physics_f64::rayleighPhase(nu);
  const physics_f64::Spectrum mie =
      medium_.mieScattering * physics_f64::miePhase(medium_.mieAsymmetry, nu);
  physics_f64::Spectrum sum(0.0), before(0.0);
  for (int i = 0; i < nodes.count(); ++i) {
    const RayNode& n = nodes[i];
    const GuideLight light = at(n.h, n.muS);
    const physics_f64::Spectrum here =
        n.transmittance *
        (n.rayleigh * (rayleigh * light.sunlight + medium_.rayleighScattering * light.mean) +
         n.mie * (mie * light.sunlight + medium_.mieScattering * light.mean));
    if (i > 0) sum += 0.5 * (n.t - nodes[i - 1].t) * (before + here);
    before = here;
  }
  if (ground && nodes.count() > 0) {
    const RayNode& n = nodes[nodes.count() - 1];
    const GuideLight light = at(0.0, n.muS);
    sum += n.transmittance * medium_.groundAlbedo *
           (light.sunlight * std::max(n.muS, 0.0) / kPi + light.mean);
  }
  return sum;
}

}  // namespace alpenglow::reference
