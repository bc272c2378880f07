// The rules by which a plan is made: docs/plan.md. Each fills in its part of a plan and the
// reasons; what that costs is told above (atmosphere/api/plan.cpp).
#pragma once

#include <alpenglow/plan.h>

#include "atmosphere/model/sentence.h"

namespace alpenglow::plan {

inline constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// What the rules ask of an air. Bounds, not values: an effect goes only where even the bound is
/// below the wanted error.
struct Air {
  double thickness_m = 0.0;  ///< From the ground to the top.
  double dipOfTop = 0.0;     ///< Radians by which the top passes into the planet's shadow.
  double scattering = 0.0;   ///< Zenith optical depth of what scatters, in the worst channel.
  double longest = 0.0;      ///< The longest way through it, as optical depth.
  double albedo = 0.0;       ///< Of the ground, in the worst channel.
  /// Most that leaving it out changes the light anywhere, as a share of that light.
  double rayleighShare = 0.0, mieShare = 0.0, absorptionShare = 0.0;
  double peakAsymmetry = 0.0;  ///< |g| of the aerosols, more without molecules to veil them.
  bool likeEarth = false;      ///< As thin a shell: twilight is no brighter than measured there.
};
Air airOf(const Parameters& parameters);

/// Ok, or a sentence about the wrong field.
Status checkNeeds(const Needs& needs, model::Sentence* why);
Status checkBase(const Needs& needs, const TableDesc& base, model::Sentence* why);
double wantedError(const Needs& needs);

/// Elevations of the sun, radians, lowest first.
struct SunRange {
  double from, to;
};
/// As the needs have it; all of them where they don't say.
SunRange sunRange(const Needs& needs);
/// And seen from all places where light is asked for: as far as the horizon, from above the top of
/// the air as far as the limb's far side.
SunRange widened(const Parameters& parameters, const Needs& needs);
/// The lowest sun whose sky light may be seen at this exposure; 0: any.
double lowestVisibleSun(const Air& air, double brightest, double exposure);
/// The lowest elevation of any sun: -pi/2.
double lowestSun();
bool limitsSun(const Needs& needs);
bool mayBeInSpace(const Air& air, const Needs& needs);
bool sees(const Needs& needs, Seen what);

/// Effects on or off, forced or not, and why.
void decideEffects(const Parameters& parameters, const TableDesc& base, Plan* plan);
/// From the effects that are on: what tables and views are without, the range of suns, the slice.
void applyEffects(const Parameters& parameters, const TableDesc& base, Plan* plan);

/// The lowest level that meets the error, by measured tables.
void decideQuality(const Parameters& parameters, const TableDesc& base, Plan* plan);
/// Sets a level and what error it has; Draft ... Ultra.
void setQuality(const Parameters& parameters, Quality quality, Plan* plan);
Quality levelOf(Quality quality);  ///< Default is Medium.
const char* levelName(Quality quality);

void copyReason(const model::Sentence& sentence, EffectChoice* choice);
/// Appends a choice.
PlanChoice* addChoice(Plan* plan, const char* name, const model::Sentence& value,
                      const model::Sentence& reason);
/// All choices in words; `unbound` is the level that the error alone would have.
/// With tables for few suns, fewer optical depths, unless the host gives their number:
/// docs/moment-solver.md, "Nodes", has what it costs.
void fitDepths(const TableDesc& base, Plan* plan);
inline constexpr uint32_t kFewDepthMu = 128, kFewDepthH = 64;
void describeChoices(const Parameters& parameters, const TableDesc& base, uint32_t solvedOrders,
                     Quality unbound, Plan* plan);

}  // namespace alpenglow::plan
