#version 460
#extension GL_GOOGLE_include_directive : require
// Shadow volumes of Bruneton & Neyret 2008, section 5: a front face subtracts 1 and its distance, a back face
// adds them. Distances are along the ray from the camera, or from where it enters the atmosphere.

#include "alpenglow/atmosphere.glsl"
#include "alpenglow/light_shafts.glsl"
#include "common/pixel_ray.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in flat float onNearPlane;

layout(location = 0) out vec2 sums;    // (dn, dz), added
layout(location = 1) out vec2 bounds;  // (-zmin, zmax), the greatest

void main() {
  vec3 view;
  Ray ray = pixelRay(gl_FragCoord.xy, view);
  float t = kOrthographic ? dot(position, view) : length(position);
  float z = max(t - ray.start, 0.0);
  // A face on the near plane is a front face, in either winding.
  float n = gl_FrontFacing || onNearPlane > 0.5 ? -1.0 : 1.0;
  sums = n * vec2(1.0, z);
  bounds = vec2(-z, z);
}
