// Interpolation between two keys of a flythrough.
#pragma once

#include <alpenglow/io/flythrough_file.h>

#include <array>
#include <string>

namespace alpenglow::io {

/// The first field of two scenes that can't change bit by bit, as a clause: "field 'exposure'
/// changes from \"auto\" to a number". Empty where there is none.
std::string whatHasNoBetween(const Scene& a, const Scene& b);

/// A segment of a flythrough between two keys, with their neighbours.
struct FlythroughSegment {
  std::array<double, 4> time = {};  ///< Of the key before, both keys, and the key after.
  bool linear = false;              ///< The segment runs at constant speed;
  bool joins[2] = {};               ///< it continues the one before; the one after continues it;
  bool joinsLinear[2] = {};         ///< and those run at constant speed.
};

/// A value at a time of the segment, from its values at the four keys: linear, or a cubic that is
/// monotone where the values are (Fritsch and Butland 1984), and at rest where nothing joins.
double valueAt(const FlythroughSegment& segment, double time, const std::array<double, 4>& values);

}  // namespace alpenglow::io
