// The rules by which a plan is made: docs/plan.md. Each fills in its part of a plan and the
// reasons; atmosphere/api/plan.cpp computes the cost.
#pragma once

#include <alpenglow/plan.h>

#include "atmosphere/parameters/sentence.h"

namespace alpenglow::plan {

inline constexpr double kDegree = 3.14159265358979323846 / 180.0;

/// Properties of a medium that the rules need. Bounds, not values: an effect is disabled only where
/// its upper bound is below the error target.
struct MediumTraits {
  double thickness_m = 0.0;  ///< From the ground to the top.
  double dipOfTop = 0.0;     ///< Radians by which the top passes into the planet's shadow.
  double scattering = 0.0;   ///< Zenith optical depth of what scatters, in the worst channel.
  double longest = 0.0;      ///< Of the longest path through it, as optical depth.
  double albedo = 0.0;       ///< Of the ground, in the worst channel.
  /// Greatest relative change of light anywhere when the constituent is left out.
  double rayleighShare = 0.0, mieShare = 0.0, absorptionShare = 0.0;
  double peakAsymmetry = 0.0;  ///< |g| of the aerosols, higher without molecules to hide it.
  bool likeEarth = false;      ///< The shell is as thin: twilight is no brighter than measured.
};
MediumTraits mediumTraits(const Parameters& parameters);

/// Ok, or a sentence about the wrong field.
Status checkRequest(const PlanRequest& request, parameters::Sentence* why);
/// Checks the request's tables, combined with the rest of the request, as a bake would.
Status checkTables(const PlanRequest& request, parameters::Sentence* why);
double wantedError(const PlanRequest& request);

/// Elevations of the sun, radians, lowest first.
struct SunRange {
  double from, to;
};
/// The range of the request, or all elevations.
SunRange sunRange(const PlanRequest& request);
/// Angle at the planet's centre from a point at this altitude to its horizon, which is also the dip
/// of that horizon. Radians.
double horizonArc(double radius_m, double altitude_m);
/// The same at all places where light is needed: as far as the horizon, from above the top of the
/// atmosphere as far as the far side of the limb.
SunRange widened(const Parameters& parameters, const PlanRequest& request);
/// The lowest sun whose sky light may be seen at this exposure; 0: any.
double lowestVisibleSun(const MediumTraits& medium, double brightest, double exposure);
/// The lowest elevation of any sun: -pi/2.
double lowestSun();
bool limitsSun(const PlanRequest& request);
bool mayBeInSpace(const MediumTraits& medium, const PlanRequest& request);
bool sees(const PlanRequest& request, VisibilityFlag what);

/// What a plan's view draws.
inline bool drawsFromLut(const Plan& plan) { return plan.view.sky == SkyMethod::Lut; }
inline bool drawsAerial(const Plan& plan) {
  return plan.view.aerialPerspective != AerialPerspective::Off;
}
inline bool drawsLightShafts(const Plan& plan) {
  return plan.view.lightShafts.method != LightShaftMethod::Off;
}

/// Effects on or off, forced or not, and why.
void decideEffects(const Parameters& parameters, Plan* plan);
/// From the effects that are on: the disabled effects of tables and views, the range of sun
/// elevations, the sky-view LUT.
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
/// Cost of the shadow map; one draw of casters; the pipelines of the light-volume mesh that read
/// tables or an aerial-perspective LUT, and the culling of its blocks.
PlanCost lightShaftCost(const Plan& plan);
/// The default of LightShaftDesc::shadowMapSize. Images of the picture's size are not counted: only
/// the host knows it.
inline constexpr uint32_t kShadowMapSize = 2048;
ImageInfo shadowMapImage();
double bakeSeconds(const PlanRequest& request, const PlanCost& cost);
/// Sets the cost, the time of a bake, and whether both are within the budget.
void setCost(const PlanCost& cost, Plan* plan);

void copyReason(const parameters::Sentence& sentence, PlanChoice* choice);
inline PlanChoice& choiceOf(Plan* plan, Effect effect) {
  return plan->choices[static_cast<uint32_t>(effect)];
}
inline bool isOn(const Plan& plan, Effect effect) {
  return plan.choices[static_cast<uint32_t>(effect)].on;
}
/// Appends a choice.
PlanChoice* addChoice(Plan* plan, const char* name, const parameters::Sentence& value,
                      const parameters::Sentence& reason);
/// For tables of a short range of sun elevations, fewer optical depths, unless the host gives their
/// number: docs/moment-solver.md, "Nodes", has the effect on accuracy.
void fitDepths(Plan* plan);
inline constexpr uint32_t kFewDepthMu = 128, kFewDepthH = 64;
/// All choices but the effects in words; `unbound` is the level that the error alone would have.
void describeChoices(const Parameters& parameters, uint32_t solvedOrders, Quality unbound,
                     Plan* plan);

}  // namespace alpenglow::plan
