#include "atmosphere/bake/moment_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

namespace alpenglow::bake {
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

// Nodes of the sun's zenith angle: densest where the top of the air passes into the planet's
// shadow, which on Earth is 7.84 degrees wide, as far as light has any way to come.
void shapeSun(const physics_f64::Medium& medium, Shape* s) {
  constexpr double kPi = std::numbers::pi;
  const double dip = std::acos(medium.bottomRadius / (medium.bottomRadius + medium.thickness));
  const double relative = dip / (7.84 * kDegree);
  const double width = std::min(10.0 * kDegree * relative, 40.0 * kDegree);
  const double center = kPi / 2.0 + std::min(5.0 * kDegree * relative, 10.0 * kDegree);
  const double last =
      std::min(kPi, std::max(center + 35.0 * kDegree * relative, kPi / 2.0 + 4.5 * dip));
  s->sunCenter = center;
  s->sunWidth = width;
  s->sunLow = std::asinh(-center / width);
  s->sunRange = std::asinh((last - center) / width) - s->sunLow;
}

}  // namespace

physics_f64::MomentShape makeMomentShapeF64(const Parameters& parameters, const TableDesc& desc) {
  const physics_f64::Medium medium = makeMediumF64(parameters);
  const MomentSettings& c = desc.moments;
  Shape s = {};
  shapeDepths(medium, &s);
  shapeSun(medium, &s);
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
  s.ringsSky = c.ringsSky;
  s.ringsLimb = c.ringsLimb;
  s.ringsGround = c.ringsGround;
  s.azimuths = c.azimuths;
  s.degree = c.degree;
  s.taper = degreeTaper(parameters);
  s.solverPanels = c.solverPanels;
  s.viewPanels = c.viewPanels;
  s.tail = desc.orders == 0 ? 1.0 : 0.0;
  return s;
}

physics_f32::MomentShape makeMomentShapeF32(const Parameters& parameters, const TableDesc& desc) {
  // Both are nothing but the same numbers, one after the other.
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

}  // namespace alpenglow::bake
