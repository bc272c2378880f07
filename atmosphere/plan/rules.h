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
Status checkRequest(const PlanRequest& request, model::Sentence* why);
/// Its tables, which a bake would take, with what the rest of it asks for.
Status checkTables(const PlanRequest& request, model::Sentence* why);
double wantedError(const PlanRequest& request);

/// Elevations of the sun, radians, lowest first.
struct SunRange {
  double from, to;
};
/// As the request has it; all of them where it doesn't say.
SunRange sunRange(const PlanRequest& request);
/// And seen from all places where light is asked for: as far as the horizon, from above the top of
/// the air as far as the limb's far side.
SunRange widened(const Parameters& parameters, const PlanRequest& request);
/// The lowest sun whose sky light may be seen at this exposure; 0: any.
double lowestVisibleSun(const Air& air, double brightest, double exposure);
/// The lowest elevation of any sun: -pi/2.
double lowestSun();
bool limitsSun(const PlanRequest& request);
bool mayBeInSpace(const Air& air, const PlanRequest& request);
bool sees(const PlanRequest& request, VisibilityFlag what);

/// What a plan's view draws.
inline bool drawsFromLut(const Plan& plan) { return plan.view.sky == SkyMethod::Lut; }
inline bool drawsAerial(const Plan& plan) {
  return plan.view.aerialPerspective != AerialPerspective::Off;
}
inline bool drawsShafts(const Plan& plan) {
  return plan.view.lightShafts.method != LightShaftMethod::Off;
}

/// Effects on or off, forced or not, and why.
void decideEffects(const Parameters& parameters, Plan* plan);
/// From the effects that are on: what tables and views are without, the range of suns, the slice.
void applyEffects(const Parameters& parameters, Plan* plan);

/// The lowest level that meets the error, by measured tables.
void decideQuality(const Parameters& parameters, Plan* plan);
/// Sets a level and what error it has; Draft ... Ultra.
void setQuality(const Parameters& parameters, Quality quality, Plan* plan);
Quality levelOf(Quality quality);  ///< Default is Medium.
const char* levelName(Quality quality);

void add(PlanCost* to, const PlanCost& more);
/// Never below 0.
PlanCost difference(const PlanCost& more, const PlanCost& less);
/// Of the map from the sun; one draw of casters and the surface between light and shadow from
/// tables and from an air volume, and the culling of its blocks.
PlanCost shaftCost(const Plan& plan);
/// LightShaftDesc::shadowMapSize as it is left; images of the picture's size are the host's to tell.
inline constexpr uint32_t kSunMapSize = 2048;
ImageInfo shadowMapImage();
double bakeSeconds(const PlanRequest& request, const PlanCost& cost);
/// And the time of a bake, and whether both keep within the budget.
void setCost(const PlanCost& cost, Plan* plan);

void copyReason(const model::Sentence& sentence, PlanChoice* choice);
inline PlanChoice& choiceOf(Plan* plan, Effect effect) {
  return plan->choices[static_cast<uint32_t>(effect)];
}
inline bool isOn(const Plan& plan, Effect effect) {
  return plan.choices[static_cast<uint32_t>(effect)].on;
}
/// Appends a choice.
PlanChoice* addChoice(Plan* plan, const char* name, const model::Sentence& value,
                      const model::Sentence& reason);
/// With tables for few suns, fewer optical depths, unless the host gives their number:
/// docs/moment-solver.md, "Nodes", has what it costs.
void fitDepths(Plan* plan);
inline constexpr uint32_t kFewDepthMu = 128, kFewDepthH = 64;
/// All choices but the effects in words; `unbound` is the level that the error alone would have.
void describeChoices(const Parameters& parameters, uint32_t solvedOrders, Quality unbound,
                     Plan* plan);

}  // namespace alpenglow::plan
