// What sections of the panel are made of.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "state.h"

namespace alpenglow::view {

struct Parameter;

/// Text where the mouse rests on the last widget.
void hint(const std::string& text);

/// A list, which Escape closes; `now` may be none of them. Whether `*chosen` was set.
bool list(const char* label, const char* shown, size_t count, size_t now,
          const std::function<const char*(size_t)>& nameOf, size_t* chosen);

/// A list of a choice's values (choices.h).
void combo(State* state, const char* name, const char* label);

/// A slider, in which a number can be typed; `id` is unique. Returns a new value once there is one:
/// while it is dragged at once, of what is typed when the typing ends.
std::optional<double> edited(State* state, const std::string& label, const std::string& id,
                             double value, const double range[2], const char* format,
                             bool logarithmic = false);

/// Sliders over all parameters of the atmosphere, or all others, under their groups' names. A value
/// that isn't allowed is left out, and State::message has the reason.
void sliders(State* state, bool ofMedium);

}  // namespace alpenglow::view
