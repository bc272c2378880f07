#version 460
#extension GL_GOOGLE_include_directive : require
// Terrain, for the depth pass and for shading: both must come to the same depth.
#include "scene_frame.glsl"

layout(push_constant) uniform TerrainPlace {
  vec4 offset;  // from the camera to the mesh's origin
} place;

layout(location = 0) in vec3 local;
layout(location = 1) in vec3 localNormal;
layout(location = 2) in vec2 mapUv;

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec2 uv;
invariant gl_Position;

void main() {
  position = local + place.offset.xyz;
  normal = localNormal;
  uv = mapUv;
  gl_Position = frame.clipFromCamera * vec4(position, 1.0);
}
