#include "choices.h"

#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/table_file.h>

#include <algorithm>
#include <span>

namespace alpenglow::view {
namespace {

Choice presetChoice() {
  Choice choice = {"preset", {}, {}, {}};
  static const std::span<const Preset> kAll = [] {
    uint32_t count = 0;
    const Preset* const first = presets(&count);
    return std::span(first, count);
  }();
  for (const Preset& preset : kAll) choice.values.emplace_back(preset.name);
  choice.get = [](const State& state) {
    const auto same = [&](const Preset& preset) {
      return io::firstDifference(preset.parameters, state.scene.atmosphere).empty();
    };
    return static_cast<size_t>(std::find_if(kAll.begin(), kAll.end(), same) - kAll.begin());
  };
  choice.set = [](State* state, size_t i) {
    if (i < kAll.size()) state->scene.atmosphere = kAll[i].parameters;
  };
  return choice;
}

// An enumeration whose values are its names' places.
template <typename Enum>
Choice enumeration(std::string name, std::vector<std::string> values, Enum io::Scene::*member) {
  return {std::move(name), std::move(values),
          [member](const State& state) { return static_cast<size_t>(state.scene.*member); },
          [member](State* state, size_t i) { state->scene.*member = static_cast<Enum>(i); }};
}

Choice modelChoice() {
  Choice choice = enumeration("model", io::modelNames(), &io::Scene::model);
  choice.set = [](State* state, size_t i) {
    state->scene.model = static_cast<io::SceneModel>(i);
    state->scene.orders.reset();
    if (state->scene.model == io::SceneModel::Single) state->scene.orders = 1;
  };
  return choice;
}

Choice solverChoice() {
  return {"solver",
          {"moments", "standard"},
          [](const State& state) {
            return static_cast<size_t>(state.scene.solver.value_or(Solver::Moments));
          },
          [](State* state, size_t i) {
            state->scene.solver = static_cast<Solver>(i);
            if (state->scene.solver == Solver::Standard) state->scene.quality.reset();
          }};
}

Choice qualityChoice() {
  Choice choice = {"quality", {"as planned"}, {}, {}};
  for (const Quality level :
       {Quality::Draft, Quality::Low, Quality::Medium, Quality::High, Quality::Ultra}) {
    choice.values.push_back(io::qualityName(level));
  }
  choice.get = [](const State& state) {
    return static_cast<size_t>(state.scene.quality.value_or(Quality::Default));
  };
  choice.set = [](State* state, size_t i) {
    state->scene.quality.reset();
    if (i > 0) state->scene.quality = static_cast<Quality>(i);
  };
  return choice;
}

Choice ordersChoice() {
  Choice choice = {"orders", {"all", "1", "2", "3", "4", "5", "10"}, {}, {}};
  const std::vector<std::string> values = choice.values;
  choice.get = [values](const State& state) {
    const std::string now = state.scene.orders ? std::to_string(*state.scene.orders) : "all";
    return static_cast<size_t>(std::find(values.begin(), values.end(), now) - values.begin());
  };
  choice.set = [values](State* state, size_t i) {
    state->scene.orders.reset();
    if (i > 0) state->scene.orders = static_cast<uint32_t>(std::stoul(values[i]));
  };
  return choice;
}

Choice starsChoice() {
  return {"stars",
          {"off", "on"},
          [](const State& state) { return state.scene.stars ? size_t{1} : size_t{0}; },
          [](State* state, size_t i) {
            if (i == 0) state->scene.stars.reset();
            if (i == 1 && !state->scene.stars) state->scene.stars.emplace();
          }};
}

Choice effectChoice(uint32_t effect) {
  return {
      std::string("effects.") + effectName(static_cast<Effect>(effect)),
      {"as planned", "on", "off"},
      [effect](const State& state) { return static_cast<size_t>(state.scene.effects[effect]); },
      [effect](State* state, size_t i) { state->scene.effects[effect] = static_cast<Force>(i); }};
}

}  // namespace

std::span<const Choice> choices() {
  static const std::vector<Choice> kChoices = [] {
    std::vector<Choice> all = {
        presetChoice(),
        modelChoice(),
        solverChoice(),
        qualityChoice(),
        ordersChoice(),
        enumeration("shafts", {"auto", "paper", "exact", "march", "off"}, &io::Scene::shafts),
        enumeration("tone_map", io::toneMapNames(), &io::Scene::toneMap),
        starsChoice()};
    for (uint32_t i = 0; i < kEffectCount; ++i) all.push_back(effectChoice(i));
    return all;
  }();
  return kChoices;
}

const Choice* findChoice(const std::string& name) {
  const std::span<const Choice> all = choices();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Choice& c) { return c.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace alpenglow::view
