#include "atmosphere/tables/moment_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

namespace alpenglow::tables {
namespace {

using Shape = physics_f64::MomentShape;
constexpr double kDegree = std::numbers::pi / 180.0;

// Of what is present; the medium has the thickness for what isn't.
void shapeDepths(const physics_f64::Medium& medium, Shape* s) {
  const double least = std::min(medium.rayleighScaleHeight, medium.mieScaleHeight);
  const double most = std::max(medium.rayleighScaleHeight, medium.mieScaleHeight);
  s->depthSharpness = std::max(2.0, std::sqrt(medium.bottomRadius / least));
  s->heightScale = std::min(medium.thickness, std::sqrt(least * most));
}

/// How far tables reach beyond the requested sun elevations, in dips of the top: as far as rays and
/// their light come from. Measured: build/bin/domain_bench.
constexpr double kReachToNight = 0.6, kReachToDay = 0.75;
/// Additional reach towards the day for each radian of the sun below the horizon: twilight comes
/// from there.
constexpr double kReachBelow = 0.75;

/// Where the top of the atmosphere passes into the planet's shadow; on Earth 7.84 degrees wide.
double dipOfTop(const physics_f64::Medium& medium) {
  return std::acos(medium.bottomRadius / (medium.bottomRadius + medium.thickness));
}

/// u of nodes is linear in this: densest around the terminator.
struct SunNodes {
  double center, width;
  double first, last;  ///< Radians, of all sun elevations: as far as light has any way to come.

  double at(double theta) const { return std::asinh((theta - center) / width); }
};

SunNodes sunNodes(const physics_f64::Medium& medium) {
  constexpr double kPi = std::numbers::pi;
  const double dip = dipOfTop(medium), relative = dip / (7.84 * kDegree);
  SunNodes nodes = {};
  nodes.width = std::min(10.0 * kDegree * relative, 40.0 * kDegree);
  nodes.center = kPi / 2.0 + std::min(5.0 * kDegree * relative, 10.0 * kDegree);
  nodes.last =
      std::min(kPi, std::max(nodes.center + 35.0 * kDegree * relative, kPi / 2.0 + 4.5 * dip));
  return nodes;
}

struct SunRange {
  double first, last;
};

/// The part of all sun elevations that a description's tables hold.
SunRange sunRange(const physics_f64::Medium& medium, const SunNodes& nodes, const TableDesc& desc) {
  if (allSuns(desc)) return {nodes.first, nodes.last};
  const double dip = dipOfTop(medium);
  const double below = std::max(desc.sunZenithFrom - std::numbers::pi / 2.0, 0.0);
  const double reach = kReachToDay * dip + kReachBelow * below;
  // A sun below all light takes the last node.
  const double last = std::min(desc.sunZenithTo + kReachToNight * dip, nodes.last);
  return {std::max(std::min(desc.sunZenithFrom, last) - reach, nodes.first), last};
}

void shapeSun(const physics_f64::Medium& medium, const TableDesc& desc, Shape* s) {
  const SunNodes nodes = sunNodes(medium);
  const SunRange range = sunRange(medium, nodes, desc);
  s->sunCenter = nodes.center;
  s->sunWidth = nodes.width;
  s->sunLow = nodes.at(range.first);
  s->sunRange = nodes.at(range.last) - s->sunLow;
}

}  // namespace

uint32_t nodesOfSunRange(const Parameters& parameters, const TableDesc& desc, uint32_t all) {
  const physics_f64::Medium medium = makeMediumF64(parameters);
  const SunNodes nodes = sunNodes(medium);
  const SunRange range = sunRange(medium, nodes, desc);
  const double share = (nodes.at(range.last) - nodes.at(range.first)) /
                       (nodes.at(nodes.last) - nodes.at(nodes.first));
  return std::clamp(static_cast<uint32_t>(std::ceil(share * (all - 1))) + 1, kLeastSunNodes,
                    std::max(all, kLeastSunNodes));
}

physics_f64::MomentShape makeMomentShapeF64(const Parameters& parameters, const TableDesc& desc) {
  const physics_f64::Medium medium = makeMediumF64(parameters);
  const TableSizes& c = desc.sizes;
  Shape s = {};
  shapeDepths(medium, &s);
  shapeSun(medium, desc, &s);
  s.depthMu = c.depthMu;
  s.depthH = c.depthH;
  s.nodesR = c.nodesR;
  s.nodesMuS = c.nodesMuS;
  s.fieldR = fieldTexels(c.nodesR);
  s.fieldMuS = fieldTexels(c.nodesMuS);
  s.sourceGamma = c.sourceGamma;
  s.sourcePsi = c.sourcePsi;
  s.sourceSharpness = std::clamp(0.5 / (1.0 - std::abs(medium.mieAsymmetry)), 2.0, 12.0);
  s.peakAsymmetry = medium.mieAsymmetry * std::abs(medium.mieAsymmetry);
  s.peakShare = 0.3;
  s.zenithsSky = c.zenithsSky;
  s.zenithsLimb = c.zenithsLimb;
  s.zenithsGround = c.zenithsGround;
  s.azimuths = c.azimuths;
  s.degree = c.degree;
  s.taper = degreeTaper(parameters);
  s.solverPanels = c.solverPanels;
  s.viewPanels = c.viewPanels;
  s.tail = desc.orders == 0 ? 1.0 : 0.0;
  s.layers = fieldLayers(desc);
  return s;
}

physics_f32::MomentShape makeMomentShapeF32(const Parameters& parameters, const TableDesc& desc) {
  // Both structs have the same members in the same order.
  using Single = physics_f32::MomentShape;
  static_assert(sizeof(Shape) == 2 * sizeof(Single));
  constexpr size_t kCount = sizeof(Single) / sizeof(float);
  const Shape exact = makeMomentShapeF64(parameters, desc);
  std::array<double, kCount> from;
  std::array<float, kCount> to;
  std::memcpy(from.data(), &exact, sizeof exact);
  for (size_t i = 0; i < kCount; ++i) to[i] = static_cast<float>(from[i]);
  Single rounded;
  std::memcpy(&rounded, to.data(), sizeof rounded);
  return rounded;
}

}  // namespace alpenglow::tables
