// shaders/glsl/physics/harmonics.glsl as C++ in float and in double.
#pragma once

#include "atmosphere/parameters/physics_cpp.h"

#define ALPENGLOW_FN inline
#define ALPENGLOW_PI 3.14159265358979323846

#define REAL(literal) static_cast<float>(literal)
namespace alpenglow::harmonics_f32 {
using namespace physics_f32;  // NOLINT: as the source has it
#include "shaders/glsl/physics/harmonics.glsl"
}  // namespace alpenglow::harmonics_f32
#undef REAL

#define REAL(literal) static_cast<double>(literal)
namespace alpenglow::harmonics_f64 {
using namespace physics_f64;  // NOLINT: as the source has it
#include "shaders/glsl/physics/harmonics.glsl"
}  // namespace alpenglow::harmonics_f64
#undef REAL

#undef ALPENGLOW_FN
#undef ALPENGLOW_PI
