// All of the physics that reads no table, in the order it needs. Include this, or in C++
// atmosphere/parameters/physics_cpp.h.
#ifndef ALPENGLOW_PHYSICS
#ifndef __cplusplus
#define ALPENGLOW_PHYSICS
#endif

#include "types.glsl"

#include "effects.glsl"

#include "medium.glsl"

#include "geometry.glsl"

#include "optical_depth.glsl"

#include "phase.glsl"

#include "mapping.glsl"

#include "field.glsl"

#include "ray_segment.glsl"

#include "sky_view_lut.glsl"

#include "aerial_perspective_lut.glsl"

#endif
