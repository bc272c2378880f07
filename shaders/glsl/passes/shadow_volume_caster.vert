#version 460
#extension GL_GOOGLE_include_directive : require
// Casters in metres from the camera, for the geometry shader.

#include "passes/caster_placement.glsl"

layout(location = 0) out vec3 position;

void main() { position = placed(); }
