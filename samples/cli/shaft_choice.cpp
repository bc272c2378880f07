#include "shaft_choice.h"

#include <cstdio>

#include "failure.h"

namespace alpenglow::cli {
namespace {

using io::SceneShafts;

SceneShafts findMethod(const std::string& name) {
  if (name == "exact") return SceneShafts::Exact;
  if (name == "paper") return SceneShafts::Paper;
  if (name == "march") return SceneShafts::March;
  return name == "off" ? SceneShafts::Off : SceneShafts::Auto;
}

const char* nameOf(SceneShafts method) {
  constexpr const char* kNames[] = {"auto", "paper", "exact", "march", "off"};
  return kNames[static_cast<size_t>(method)];
}

}  // namespace

CapabilityFlags ShaftChoice::needs() const {
  if (method == SceneShafts::Off || method == SceneShafts::Auto) return 0;
  return method == SceneShafts::Paper ? kCapabilityShafts | kCapabilityShadowVolumes
                                      : CapabilityFlags{kCapabilityShafts};
}

CapabilityFlags ShaftChoice::wishes() const {
  return method == SceneShafts::Auto ? kCapabilityShafts : CapabilityFlags{0};
}

ShaftChoice chooseShafts(const RenderArguments& arguments, const io::Scene& scene, Solver solver) {
  ShaftChoice choice;
  choice.method = arguments.shafts ? findMethod(*arguments.shafts) : scene.shafts;
  choice.samples = scene.shaftSamples;
  if (arguments.shaftSamples) {
    if (choice.method != SceneShafts::March) {
      throw Failure("--shaft-samples " + *arguments.shaftSamples +
                        " belongs to the light shafts march, but " +
                        (arguments.shafts ? "--shafts " : "the scene's are ") +
                        nameOf(choice.method) + (arguments.shafts ? " was given." : "."),
                    Failure::kUsage);
    }
    choice.samples = static_cast<uint32_t>(parseSamples(*arguments.shaftSamples));
  }
  if (!scene.terrain) choice.method = SceneShafts::Off;  // Nothing casts any.
  if (solver == Solver::Moments || choice.method == SceneShafts::Off) return choice;
  const std::string other = solver == Solver::Standard ? "standard" : "a simpler model";
  if (choice.method != SceneShafts::Auto) {
    throw Failure(std::string("The light shafts ") + nameOf(choice.method) +
                  " need tables of the solver moments, but these are of " + other + ".");
  }
  choice.whyOff = "they need tables of the solver moments, and these are of " + other + ".";
  choice.method = SceneShafts::Off;
  return choice;
}

LightShaftDesc describeShafts(const ShaftChoice& choice, const Session& session) {
  const std::string& why = choice.whyOff.empty() ? session.unfulfilled() : choice.whyOff;
  if (!why.empty()) std::fprintf(stderr, "The picture has no light shafts: %s\n", why.c_str());
  if (choice.method == SceneShafts::Off || !why.empty()) return {};
  LightShaftDesc desc;
  if (choice.method == SceneShafts::March) desc.stepCount = choice.samples;
  desc.method = choice.method == SceneShafts::Paper   ? LightShaftMethod::ShadowVolume
                : choice.method == SceneShafts::March ? LightShaftMethod::RayMarch
                                                      : LightShaftMethod::LightVolume;
  return desc;
}

}  // namespace alpenglow::cli
