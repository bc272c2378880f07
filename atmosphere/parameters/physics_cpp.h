// The physics of shaders/glsl/physics as C++: the same source, included twice, with float in
// alpenglow::physics_f32 (the GPU's arithmetic) and double in alpenglow::physics_f64 (the
// reference's). Internal: it brings GLM along, which the public headers don't.
#pragma once

#include <alpenglow/parameters.h>

#include <cmath>
#include <glm/glm.hpp>

// The code has GLSL's implicit style: unused parameters and shadowing rules of the shader language.
#define IN(type) const type&
#define OUT(type) type&
#define ALPENGLOW_FN inline
#define ALPENGLOW_STD140(type) alignas(16) type
#define ALPENGLOW_PI 3.14159265358979323846
#define SPECTRUM(value) Spectrum(value)

namespace alpenglow::physics_f32 {
using namespace glm;  // NOLINT: the names that GLSL has built in
using Real = float;
using Real2 = glm::vec2;
using Real3 = glm::vec3;
using Real4 = glm::vec4;
using Spectrum = glm::vec3;
#define REAL(literal) static_cast<float>(literal)
#include "shaders/glsl/physics/physics.glsl"
#undef REAL
}  // namespace alpenglow::physics_f32

namespace alpenglow::physics_f64 {
using namespace glm;  // NOLINT
using Real = double;
using Real2 = glm::dvec2;
using Real3 = glm::dvec3;
using Real4 = glm::dvec4;
using Spectrum = glm::dvec3;
#define REAL(literal) static_cast<double>(literal)
#include "shaders/glsl/physics/physics.glsl"
#undef REAL
}  // namespace alpenglow::physics_f64

#undef IN
#undef OUT
#undef ALPENGLOW_FN
#undef ALPENGLOW_STD140
#undef ALPENGLOW_PI
#undef SPECTRUM

namespace alpenglow {

/// The medium of validated parameters, ready for the physics. An absent constituent has zero
/// coefficients and harmless lengths.
physics_f64::Medium makeMediumF64(const Parameters& parameters);
physics_f32::Medium makeMediumF32(const Parameters& parameters);

}  // namespace alpenglow
