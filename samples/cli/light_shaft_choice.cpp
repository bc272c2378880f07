#include "light_shaft_choice.h"

#include <cstdio>

#include "failure.h"

namespace alpenglow::cli {
namespace {

using io::SceneLightShafts;

SceneLightShafts findMethod(const std::string& name) {
  if (name == "exact") return SceneLightShafts::LightVolume;
  if (name == "paper") return SceneLightShafts::ShadowVolume;
  if (name == "march") return SceneLightShafts::RayMarch;
  return name == "off" ? SceneLightShafts::Off : SceneLightShafts::Auto;
}

const char* nameOf(SceneLightShafts method) {
  constexpr const char* kNames[] = {"auto", "paper", "exact", "march", "off"};
  return kNames[static_cast<size_t>(method)];
}

}  // namespace

CapabilityFlags LightShaftChoice::requirements() const {
  if (method == SceneLightShafts::Off || method == SceneLightShafts::Auto) return 0;
  return method == SceneLightShafts::ShadowVolume
             ? kCapabilityLightShafts | kCapabilityShadowVolumes
             : CapabilityFlags{kCapabilityLightShafts};
}

CapabilityFlags LightShaftChoice::wishes() const {
  return method == SceneLightShafts::Auto ? kCapabilityLightShafts : CapabilityFlags{0};
}

LightShaftChoice chooseLightShafts(const RenderArguments& arguments, const io::Scene& scene,
                                   Solver solver) {
  LightShaftChoice choice;
  choice.method = arguments.shafts ? findMethod(*arguments.shafts) : scene.shafts;
  choice.stepCount = scene.lightShaftStepCount;
  if (arguments.lightShaftStepCount) {
    if (choice.method != SceneLightShafts::RayMarch) {
      throw Failure("--shaft-samples " + *arguments.lightShaftStepCount +
                        " belongs to the light shafts march, but " +
                        (arguments.shafts ? "--shafts " : "the scene's are ") +
                        nameOf(choice.method) + (arguments.shafts ? " was given." : "."),
                    Failure::kUsage);
    }
    choice.stepCount = static_cast<uint32_t>(parseSamples(*arguments.lightShaftStepCount));
  }
  if (!scene.terrain) choice.method = SceneLightShafts::Off;  // Nothing casts any.
  if (solver == Solver::Moments || choice.method == SceneLightShafts::Off) return choice;
  const std::string other = solver == Solver::Standard ? "standard" : "a simpler model";
  if (choice.method != SceneLightShafts::Auto) {
    throw Failure(std::string("The light shafts ") + nameOf(choice.method) +
                  " need tables of the solver moments, but these are of " + other + ".");
  }
  choice.whyOff = "they need tables of the solver moments, and these are of " + other + ".";
  choice.method = SceneLightShafts::Off;
  return choice;
}

LightShaftDesc describeLightShafts(const LightShaftChoice& choice, const Session& session) {
  const std::string& why = choice.whyOff.empty() ? session.unfulfilled() : choice.whyOff;
  if (!why.empty()) std::fprintf(stderr, "The picture has no light shafts: %s\n", why.c_str());
  if (choice.method == SceneLightShafts::Off || !why.empty()) return {};
  LightShaftDesc desc;
  if (choice.method == SceneLightShafts::RayMarch) desc.stepCount = choice.stepCount;
  desc.method = choice.method == SceneLightShafts::ShadowVolume ? LightShaftMethod::ShadowVolume
                : choice.method == SceneLightShafts::RayMarch   ? LightShaftMethod::RayMarch
                                                                : LightShaftMethod::LightVolume;
  return desc;
}

}  // namespace alpenglow::cli
