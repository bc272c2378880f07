#version 460
#extension GL_GOOGLE_include_directive : require
// Casters as the sun sees them: a parallel projection.

#include "passes/caster_placement.glsl"

void main() { gl_Position = vec4(placed(), 1.0); }
