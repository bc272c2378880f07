#version 460
#extension GL_GOOGLE_include_directive : require
// Casters in the shadow map: a parallel projection along the sun's beam.

#include "passes/caster_placement.glsl"

void main() { gl_Position = vec4(placed(), 1.0); }
