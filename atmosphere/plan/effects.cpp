// Which effects are simulated, and why.
#include <algorithm>
#include <cmath>

#include "atmosphere/plan/rules.h"

namespace alpenglow::plan {
namespace {

constexpr double degrees(double radians) { return std::round(radians / kDegree * 100.0) / 100.0; }
double percent(double share) { return std::round(share * 1e4) / 100.0; }

class Decider {
 public:
  Decider(const Parameters& parameters, Plan* plan)
      : p_(parameters),
        base_(plan->request.tables),
        plan_(plan),
        request_(plan->request),
        medium_(mediumTraits(parameters)),
        error_(wantedError(plan->request)),
        range_(widened(parameters, plan->request)) {}

  void decide() {
    matter(Effect::Rayleigh, p_.rayleigh.present, medium_.rayleighShare, "molecules");
    matter(Effect::Mie, p_.mie.present, medium_.mieShare, "aerosols");
    matter(Effect::Absorption, p_.absorption.present, medium_.absorptionShare, "absorbing layer");
    multiple();
    reflection();
    irradiance();
    seen();
    shafts();
    space();
    twilight();
    night();
  }

 private:
  bool on(Effect effect) const { return isOn(*plan_, effect); }

  void write(Effect effect, bool on, bool forced, const parameters::Sentence& reason) {
    PlanChoice& choice = choiceOf(plan_, effect);
    choice = {};
    (parameters::Sentence() << effectName(effect)).copyTo(choice.name, sizeof choice.name);
    (parameters::Sentence() << (on ? "on" : "off")).copyTo(choice.value, sizeof choice.value);
    choice.on = on;
    choice.forced = forced;
    copyReason(reason, &choice);
  }

  // Choices that the host forces override the rules.
  void set(Effect effect, bool on, const parameters::Sentence& reason) {
    const Force force = request_.effects[static_cast<uint32_t>(effect)];
    parameters::Sentence why;
    const bool table = (kTableEffects & effectBit(effect)) != 0;
    if (force != Force::Auto) {
      const bool forcedOn = force == Force::On;
      why << "Turned " << (forcedOn ? "on" : "off") << " by the scene.";
      write(effect, forcedOn, true, why);
    } else if (table && !hasEffect(base_.disabledEffects, effect)) {
      why << "The given description of the tables disables it.";
      write(effect, false, true, why);
    } else if (table && base_.solver != Solver::Moments) {
      why << "Only tables of the solver moments can disable it.";
      write(effect, true, false, why);
    } else {
      write(effect, on, false, reason);
    }
  }

  // Impossible even if the host forces it.
  void impossible(Effect effect, const char* reason) {
    write(effect, false, false, parameters::Sentence() << reason);
  }

  void matter(Effect effect, bool present, double share, const char* what) {
    parameters::Sentence why;
    const bool counts = present && share > error_;
    if (!present || share <= 0.0) {
      why << "The atmosphere has no " << what << ".";
    } else if (counts) {
      why << "The " << what << " may change light by up to " << percent(share)
          << " %, more than the wanted " << percent(error_) << " %.";
    } else {
      why << "The " << what << " change light by at most " << percent(share)
          << " %, within the wanted " << percent(error_) << " %.";
    }
    set(effect, counts, why);
  }

  // Light of two events relative to that of one: the second event receives light from all around,
  // along paths that grow like the logarithm of the longest; in twilight it lights what the first
  // can't.
  void multiple() {
    parameters::Sentence why;
    const double ways = 1.0 + std::log1p(medium_.longest / std::max(medium_.scattering, 1e-12));
    const double share = 2.0 * medium_.scattering * ways * (range_.from < 0.0 ? 10.0 : 1.0) +
                         (reflects() ? 2.0 * medium_.albedo : 0.0);
    const bool one = base_.orders == 1;
    const bool counts = !one && (share > error_ || base_.orders > 1);
    if (one) {
      why << "One order was asked for.";
    } else if (base_.orders > 1) {
      why << "Paths of up to " << base_.orders << " events were asked for.";
    } else {
      why << "Paths of two events and more may add "
          << (counts && share > 1.0 ? "as much light as those of one" : "up to ");
      if (!(counts && share > 1.0)) why << percent(share) << " %";
      why << ", " << (counts ? "more than" : "within") << " the wanted " << percent(error_)
          << " %.";
    }
    set(Effect::MultipleScattering, counts, why);
  }

  double reflected() const {
    return 2.0 * medium_.albedo * std::min(1.0, std::max(std::sin(range_.to), 0.0) + 0.3);
  }
  bool reflects() const { return reflected() > error_; }

  void reflection() {
    if (base_.solver == Solver::Moments && !on(Effect::MultipleScattering)) {
      impossible(Effect::GroundReflection,
                 "Light from the ground into the atmosphere is of two events, which are left out.");
      return;
    }
    parameters::Sentence why;
    why << "The ground's albedo of up to " << medium_.albedo << " gives the atmosphere at most "
        << percent(reflected()) << " % of its light, " << (reflects() ? "more than" : "within")
        << " the wanted " << percent(error_) << " %.";
    set(Effect::GroundReflection, reflects(), why);
  }

  void irradiance() {
    if (base_.solver == Solver::Moments && !on(Effect::MultipleScattering)) {
      impossible(Effect::GroundIrradiance,
                 "Light of the sky on surfaces is of two events, which are left out.");
      return;
    }
    const bool ground = sees(request_, kVisibleGround), terrain = sees(request_, kVisibleScene);
    parameters::Sentence why;
    if (ground || terrain) {
      why << (ground ? "The ground" : "The scene's terrain")
          << " may be in view, and the sky lights it.";
    } else {
      why << "Neither ground nor terrain comes into view.";
    }
    set(Effect::GroundIrradiance, ground || terrain, why);
  }

  void seen() {
    parameters::Sentence ground, disc, medium;
    ground << "The ground " << (sees(request_, kVisibleGround) ? "may come" : "doesn't come")
           << " into view.";
    set(Effect::Ground, sees(request_, kVisibleGround), ground);
    if (request_.view.projection == Projection::Orthographic && !on(Effect::Ground)) {
      parameters::Sentence why;
      why << "Rays of an orthographic camera may end on the ground.";
      write(Effect::Ground, true, false, why);
    }
    const bool drawn = request_.sunDiscRadius > 0.0 && sees(request_, kVisibleSun);
    if (request_.sunDiscRadius <= 0.0) {
      disc << "The sun is drawn without a disc.";
    } else if (drawn) {
      disc << "A disc of " << degrees(request_.sunDiscRadius) << " degrees may come into view.";
    } else {
      disc << "The sun doesn't come into view.";
    }
    set(Effect::SunDisc, drawn, disc);
    if (request_.view.projection == Projection::Fisheye) {
      impossible(Effect::AerialPerspective,
                 "A fisheye view has no depth image: a host's scene is drawn as triangles.");
      return;
    }
    medium << (sees(request_, kVisibleScene)
                   ? "The host's scene may stand in the atmosphere in view."
                   : "No scene of the host's comes into view.");
    set(Effect::AerialPerspective, sees(request_, kVisibleScene), medium);
  }

  void shafts() {
    if (base_.solver != Solver::Moments) {
      impossible(Effect::LightShafts, "Light shafts need tables of the solver moments.");
      return;
    }
    if (!on(Effect::AerialPerspective)) {
      impossible(Effect::LightShafts,
                 "Shadows in the atmosphere fall from a scene of the host's, and none is in view.");
      return;
    }
    const double top = request_.casterAltitude_m;
    const double dip = top > 0.0 ? horizonArc(p_.bottomRadius_m, top) : medium_.dipOfTop;
    // A degree more: casters stand some way from the camera, whose sun the range is.
    const double lowest = -std::min(dip, medium_.dipOfTop) - p_.sunAngularRadius - kDegree;
    const bool lit = range_.to > lowest;
    parameters::Sentence why;
    if (!request_.casters) {
      why << "Nothing casts shadows.";
    } else if (lit) {
      why << "Casters stand in a medium that the sun lights from up to " << degrees(range_.to)
          << " degrees.";
    } else {
      why << "The sun stays below " << degrees(lowest)
          << " degrees: the planet's own shadow covers all casters.";
    }
    set(Effect::LightShafts, request_.casters && lit, why);
  }

  void space() {
    const bool high = mayBeInSpace(medium_, request_);
    if (request_.view.projection == Projection::Orthographic && !high) {
      parameters::Sentence why;
      why << "Rays of an orthographic camera may begin above the atmosphere.";
      write(Effect::SpaceViews, true, false, why);
      return;
    }
    parameters::Sentence why;
    if (request_.altitudeTo_m == 0.0) {
      why << "The camera's altitude has no limit; the atmosphere ends at " << medium_.thickness_m
          << " m.";
    } else {
      why << "The camera stays between " << request_.altitudeFrom_m << " and "
          << request_.altitudeTo_m << " m"
          << (high ? ", and the atmosphere ends at " : ", below the top of the atmosphere at ")
          << medium_.thickness_m << " m.";
    }
    set(Effect::SpaceViews, high, why);
  }

  // The lowest sun whose light is visible: only where the table of brightness is valid, low in the
  // atmosphere.
  double visible() const {
    const bool low = request_.altitudeTo_m > 0.0 && request_.altitudeTo_m <= 3000.0;
    const double brightest =
        *std::max_element(p_.solarIrradiance.value, p_.solarIrradiance.value + kSpectrumSize);
    return low ? lowestVisibleSun(medium_, brightest, request_.exposure) : lowestSun();
  }

  void dark(Effect effect, double above, const char* called, bool reaches) {
    const double lowest = visible();
    parameters::Sentence why;
    const bool hidden = reaches && lowest >= above;
    why << "The sun, from " << degrees(range_.from) << " to " << degrees(range_.to)
        << " degrees high over all places in view, ";
    if (hidden) {
      why << "gives less than half an 8-bit step at exposure " << request_.exposure << " below "
          << degrees(lowest) << ".";
    } else {
      why << (reaches ? "reaches " : "never reaches ") << called << ".";
    }
    set(effect, reaches && !hidden, why);
  }

  void twilight() {
    dark(Effect::Twilight, 0.0, "twilight, below 0",
         range_.from < 0.0 && range_.to >= -18.0 * kDegree);
  }
  void night() {
    dark(Effect::Night, -18.0 * kDegree, "night, below -18", range_.from < -18.0 * kDegree);
  }

  const Parameters& p_;
  const TableDesc& base_;
  Plan* plan_;
  const PlanRequest& request_;
  MediumTraits medium_;
  double error_;
  SunRange range_;
};

// Sun elevations of the tables: those of the request, minus those without visible light, plus those
// of effects that are on anyway.
SunRange tableSuns(const Parameters& parameters, const Plan& plan) {
  const SunRange all = widened(parameters, plan.request);
  double from = all.from;
  const bool twilight = isOn(plan, Effect::Twilight), night = isOn(plan, Effect::Night);
  constexpr double kNight = -18.0 * kDegree;
  if (!night) from = std::max(from, kNight);
  if (!twilight && !night) from = std::max(from, 0.0);
  if (twilight && all.from >= 0.0) from = kNight;
  if (night && all.from >= kNight) from = lowestSun();
  return {std::min(from, all.to), all.to};
}

}  // namespace

void decideEffects(const Parameters& parameters, Plan* plan) {
  plan->choiceCount = kEffectCount;
  Decider(parameters, plan).decide();
}

void applyEffects(const Parameters& parameters, Plan* plan) {
  const auto on = [plan](Effect effect) { return isOn(*plan, effect); };
  const TableDesc& base = plan->request.tables;
  TableDesc& desc = plan->tables;
  EffectFlags disabledEffects = 0;
  for (uint32_t i = 0; i < kEffectCount; ++i)
    if (!plan->choices[i].on) disabledEffects |= effectBit(static_cast<Effect>(i));
  const bool moments = desc.solver == Solver::Moments;
  desc.disabledEffects = moments ? disabledEffects & kTableEffects : base.disabledEffects;
  plan->view.disabledEffects = (disabledEffects & kViewEffects) | desc.disabledEffects;
  if (moments && base.sunZenithFrom == 0.0 && base.sunZenithTo == 0.0) {
    constexpr double kRightAngle = 90.0 * kDegree;
    const SunRange elevations = tableSuns(parameters, *plan);
    const bool any = elevations.from <= -kRightAngle && elevations.to >= kRightAngle;
    desc.sunZenithFrom = any ? 0.0 : std::max(kRightAngle - elevations.to, 0.0);
    // Both zero would be any sun.
    desc.sunZenithTo =
        any ? 0.0 : std::clamp(kRightAngle - elevations.from, 1e-6, 2.0 * kRightAngle);
  }
  const bool slices = desc.solver == Solver::Standard || desc.solver == Solver::Hillaire;
  plan->view.sky = (plan->request.view.projection != Projection::Orthographic &&
                    (moments || (slices && !on(Effect::SpaceViews))))
                       ? SkyMethod::Lut
                       : SkyMethod::Integrate;
  if (!on(Effect::AerialPerspective))
    plan->view.aerialPerspective = AerialPerspective::Off;
  else if (plan->view.aerialPerspective == AerialPerspective::Off)
    plan->view.aerialPerspective = AerialPerspective::On;
  if (!on(Effect::LightShafts))
    plan->view.lightShafts.method = LightShaftMethod::Off;
  else if (plan->view.lightShafts.method == LightShaftMethod::Off)
    plan->view.lightShafts.method = LightShaftMethod::LightVolume;
  plan->capabilities = kCapabilityBake | kCapabilitySky;
  if (drawsAerial(*plan)) plan->capabilities |= kCapabilityAerialPerspective;
  if (drawsLightShafts(*plan)) {
    plan->capabilities |= kCapabilityLightShafts;
    if (plan->view.lightShafts.method == LightShaftMethod::ShadowVolume)
      plan->capabilities |= kCapabilityShadowVolumes;
  }
}

}  // namespace alpenglow::plan
