// Everything of a scene that is one of several: by name, for panel and script.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "state.h"

namespace alpenglow::view {

struct Choice {
  std::string name;  ///< "solver", "quality", "effects.mie" ...
  std::vector<std::string> values;
  std::function<size_t(const State&)> get;
  std::function<void(State*, size_t)> set;
};

/// The atmosphere's preset is the first: beyond its last value where it is of no preset.
std::span<const Choice> choices();
const Choice* findChoice(const std::string& name);

}  // namespace alpenglow::view
