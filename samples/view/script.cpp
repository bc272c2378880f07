#include "script.h"

#include <alpenglow/io/file.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>

#include "choices.h"
#include "common/failure.h"
#include "parameters.h"

namespace alpenglow::view {
namespace {

constexpr uint32_t kMostFramesToSettle = 20000;
constexpr char kTurbidity[] = "turbidity";
const std::vector<std::string> kSections = {"Sun",     "Picture", "Atmosphere", "Method",
                                            "Effects", "Tables",  "Cost"};

// Words of each step after its own: how many, and whether they are numbers.
struct Shape {
  size_t least, most;
  bool numbers;
};
const std::map<std::string, Shape>& shapes() {
  static const std::map<std::string, Shape> kShapes = {
      {"frames", {1, 1, true}},  {"settle", {0, 0, false}},   {"press", {1, 2, false}},
      {"seconds", {1, 1, true}}, {"show", {1, 9, false}},     {"fly", {4, 4, true}},
      {"drag", {2, 2, true}},    {"resize", {2, 2, true}},    {"set", {2, 2, false}},
      {"choose", {2, 3, false}}, {"exposure", {1, 1, false}}, {"seek", {1, 1, true}},
      {"random", {2, 2, true}},  {"save", {1, 1, false}},     {"report", {1, 1, false}},
      {"quit", {0, 0, false}}};
  return kShapes;
}

bool isNumber(const std::string& word) {
  size_t end = 0;
  try {
    return std::isfinite(std::stod(word, &end)) && end == word.size();
  } catch (const std::exception&) {
    return false;
  }
}

// Names of the same group, or all.
std::string parametersLike(const std::string& name) {
  const std::string group = name.substr(0, name.find('.') + 1);
  std::string same, all = kTurbidity;
  for (const Parameter& parameter : parameters()) {
    all += ", " + parameter.name;
    if (group.empty() || !parameter.name.starts_with(group)) continue;
    same += (same.empty() ? "" : ", ") + parameter.name;
  }
  return same.empty() ? all : same;
}

}  // namespace

Script::Script(const std::string& path, const std::vector<Binding>& bindings)
    : path_(path), bindings_(bindings) {
  std::istringstream lines(samples::take(io::readFile(path, 1 << 20)));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line.substr(0, line.find('#')));
    Step step = {number, {}};
    for (std::string word; words >> word;) step.words.push_back(word);
    if (step.words.empty()) continue;
    check(step);
    steps_.push_back(step);
  }
}

void Script::refuse(const Step& step, const std::string& why) const {
  throw samples::Failure("Line " + std::to_string(step.line) + " of the script '" + path_ +
                         "': " + why);
}

void Script::check(const Step& step) const {
  const std::string& what = step.words[0];
  const auto found = shapes().find(what);
  if (found == shapes().end()) {
    std::string names;
    for (const auto& [name, shape] : shapes()) names += (names.empty() ? "" : ", ") + name;
    refuse(step, "'" + what + "' is no step; these exist: " + names + ".");
  }
  const Shape& shape = found->second;
  const size_t count = step.words.size() - 1;
  if (count < shape.least || count > shape.most) {
    refuse(step, "'" + what + "' has " + std::to_string(count) + " words after it, but " +
                     std::to_string(shape.least) + (shape.most > shape.least ? " or more" : "") +
                     " are expected.");
  }
  for (size_t i = 1; shape.numbers && i < step.words.size(); ++i) {
    if (!isNumber(step.words[i])) {
      refuse(step, "'" + step.words[i] + "' was given, but a number is expected.");
    }
  }
  const auto inRange = [&](size_t i, double least, double most) {
    const double given = step.number(i);
    if (given >= least && given <= most) return;
    char text[160];
    std::snprintf(text, sizeof text, "%g was given, but a number from %g to %g is expected.", given,
                  least, most);
    refuse(step, text);
  };
  if (what == "frames" || what == "random") inRange(1, 0.0, 1e9);
  if (what == "random") inRange(2, 0.0, 4e9);
  if (what == "fly") inRange(4, 0.0, 1e9);
  for (size_t i = 1; what == "resize" && i <= 2; ++i) inRange(i, 16.0, 16384.0);
  if (what == "press" && keyNamed(step.words[1]) == 0) {
    refuse(step, "'" + step.words[1] + "' is no key's name, such as W, F1 or Period.");
  }
  if (what == "set" && step.words[1] != kTurbidity && findParameter(step.words[1]) == nullptr) {
    refuse(step, "there is no parameter '" + step.words[1] +
                     "'; these exist: " + parametersLike(step.words[1]) + ".");
  }
  if (what == "set" && !isNumber(step.words[2])) {
    refuse(step, "'" + step.words[2] + "' was given, but a number is expected.");
  }
  const std::string last = step.words.back();
  if (what == "save" && !last.ends_with(".png") && !last.ends_with(".exr")) {
    refuse(step, "'" + last + "' was given, but a name that ends in .png or .exr is expected.");
  }
  for (size_t i = 1; what == "show" && i < step.words.size(); ++i) {
    const bool known =
        std::find(kSections.begin(), kSections.end(), step.words[i]) != kSections.end();
    if (known) continue;
    std::string names;
    for (const std::string& name : kSections) names += (names.empty() ? "" : ", ") + name;
    refuse(step, "there is no section '" + step.words[i] + "'; these exist: " + names + ".");
  }
  if (what == "exposure" && step.words[1] != "auto" && !isNumber(step.words[1])) {
    refuse(step, "'" + step.words[1] + "' was given, but a number or auto is expected.");
  }
}

void Script::change(const Step& step, State* state) const {
  const std::string& name = step.words[1];
  if (step.words[0] == "set") {
    if (name == kTurbidity) {
      setTurbidity(&state->scene.atmosphere, step.number(2));
    } else {
      findParameter(name)->set(&state->scene, step.number(2));
    }
    const std::string why = whyInvalid(state->scene);
    if (!why.empty()) refuse(step, why);
    return;
  }
  const Choice* choice = findChoice(name);
  if (choice == nullptr) refuse(step, "there is no choice '" + name + "', such as solver.");
  std::string value = step.words[2];
  if (step.words.size() > 3) value += " " + step.words[3];  // "as planned"
  const auto found = std::find(choice->values.begin(), choice->values.end(), value);
  if (found == choice->values.end()) {
    std::string names;
    for (const std::string& one : choice->values) names += (names.empty() ? "" : ", ") + one;
    refuse(step, name + " '" + value + "' was given, but one of " + names + " is expected.");
  }
  choice->set(state, static_cast<size_t>(found - choice->values.begin()));
}

// Within a factor of two of what it is, or anywhere in its range if that is linear.
void Script::changeRandomly(State* state) {
  const std::span<const Parameter> all = parameters();
  const io::Scene before = state->scene;
  const Parameter& parameter = all[random_() % all.size()];
  if (parameter.find(state->scene) == nullptr) return;
  const double share = std::uniform_real_distribution(0.0, 1.0)(random_);
  const double value = parameter.logarithmic
                           ? parameter.get(state->scene) * std::exp2(0.4 * (share - 0.5))
                           : parameter.least + share * (parameter.most - parameter.least);
  parameter.set(&state->scene, value);
  if (!whyInvalid(state->scene).empty()) state->scene = before;
}

bool Script::run(const Step& step, State* state, const ScriptHost& host) {
  const std::string& what = step.words[0];
  if (what == "settle") {
    if (host.settled() && waited_ > 2) {
      waited_ = 0;
      return false;
    }
    if (++waited_ > kMostFramesToSettle) {
      refuse(step, "the scene is not at rest after " + std::to_string(waited_) + " frames.");
    }
    --next_;  // Again, with the next frame.
    return true;
  }
  if (what == "seconds") {
    until_ =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(
                           std::chrono::duration<double>(std::clamp(step.number(1), 0.0, 1e6)));
    return false;
  }
  if (what == "frames" || what == "random" || what == "fly") {
    const size_t count = what == "fly" ? 4 : 1;
    frames_ = static_cast<uint32_t>(step.number(count));
    if (what == "random") random_.seed(static_cast<uint32_t>(step.number(2)));
    return false;
  }
  if (what == "press") {
    const bool shift = step.words.size() > 2 && step.words[2] == "shift";
    for (const Binding& binding : bindings_) {
      if (binding.key == keyNamed(step.words[1])) press(state, binding.action, shift);
    }
  } else if (what == "drag") {
    const double pixels[2] = {step.number(1), step.number(2)};
    turn(&state->scene, pixels, state->scene.height);
  } else if (what == "resize") {
    host.resize(static_cast<uint32_t>(step.number(1)), static_cast<uint32_t>(step.number(2)));
  } else if (what == "exposure") {
    state->scene.exposure.reset();
    if (step.words[1] != "auto") state->scene.exposure = step.number(1);
  } else if (what == "seek") {
    if (!host.seek(step.number(1))) refuse(step, "there is no flythrough to seek in.");
  } else if (what == "show") {
    state->sections.assign(step.words.begin() + 1, step.words.end());
  } else if (what == "save") {
    state->screenshot = step.words[1];
    return true;
  } else if (what == "report") {
    host.report(step.words[1]);
  } else if (what == "quit") {
    state->quit = true;
  } else {
    change(step, state);
  }
  return false;
}

void Script::step(State* state, const ScriptHost& host) {
  while (true) {
    if (Clock::now() < until_ || !state->screenshot.empty()) return;
    if (frames_ > 0) {
      --frames_;
      const Step& step = steps_[next_ - 1];
      if (step.words[0] == "random") changeRandomly(state);
      if (step.words[0] == "fly") {
        const double amounts[3] = {step.number(1), step.number(2), step.number(3)};
        fly(&state->scene, amounts, false, 1.0 / 60.0);
      }
      return;
    }
    if (next_ >= steps_.size() || state->quit) return;
    const Step& step = steps_[next_++];
    if (run(step, state, host)) return;
  }
}

}  // namespace alpenglow::view
