// The tone maps of shaders/glsl/alpenglow/tone_map.glsl as C++: the same source.
#pragma once

#include <algorithm>
#include <cmath>

namespace alpenglow::io::tone {
using std::max;
using std::min;
using std::pow;
#define ALPENGLOW_FN inline
#include "alpenglow/tone_map.glsl"
#undef ALPENGLOW_FN
#undef ALPENGLOW_TONE_MAP
}  // namespace alpenglow::io::tone
