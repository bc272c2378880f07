// Which sun elevations the tables cover, and at which of them light is visible.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "atmosphere/plan/rules.h"

namespace alpenglow::plan {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2.0;

// The brightest sky towards the sun, seen from 2 m, for unit solar irradiance (`alpenglow probe` of
// the presets; docs/plan.md): the greatest of earth, earth-hazy and earth-clear; and of mars, whose
// atmosphere reaches three times as high.
struct Twilight {
  double depression;  ///< Degrees.
  double earth, mars;
};
constexpr Twilight kTwilight[] = {
    {0, 0.136, 0.136},      {2, 0.0158, 0.0334},    {4, 0.00609, 0.0184},   {6, 0.00209, 0.00949},
    {8, 0.000611, 0.00451}, {10, 1.5e-4, 0.00199},  {12, 2.85e-5, 8.15e-4}, {14, 2.55e-6, 3.16e-4},
    {16, 1.12e-7, 1.17e-4}, {18, 2.29e-8, 4.25e-5}, {20, 4.19e-9, 1.68e-5}};
/// Margin: atmospheres differ, and at other altitudes the sky is somewhat brighter.
constexpr double kMargin = 4.0;
/// Half an 8-bit step of sRGB's straight part.
constexpr double kHalfStep = 0.5 / 255.0 / 12.92;

}  // namespace

double horizonArc(double radius_m, double altitude_m) {
  return std::acos(radius_m / (radius_m + std::max(altitude_m, 0.0)));
}

SunRange widened(const Parameters& parameters, const PlanRequest& request) {
  SunRange range = sunRange(request);
  const MediumTraits medium = mediumTraits(parameters);
  double arc = request.altitudeTo_m == 0.0
                   ? kRightAngle
                   : horizonArc(parameters.bottomRadius_m, request.altitudeTo_m);
  if (mayBeInSpace(medium, request)) arc += medium.dipOfTop;
  range.from = std::max(range.from - arc, -kRightAngle);
  range.to = std::min(range.to + arc, kRightAngle);
  return range;
}

double lowestVisibleSun(const MediumTraits& medium, double brightest, double exposure) {
  if (exposure == 0.0) return -kRightAngle;
  for (const Twilight& at : kTwilight) {
    const double light = (medium.likeEarth ? at.earth : at.mars) * brightest * kMargin;
    if (light * exposure < kHalfStep) return -at.depression * kDegree;
  }
  return -kRightAngle;
}

}  // namespace alpenglow::plan
