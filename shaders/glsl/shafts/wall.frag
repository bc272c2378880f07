#version 460
#extension GL_GOOGLE_include_directive : require
// What a wall of shadow does to the rays through it: single scattering of all that lies before it is lit if
// the ray enters shadow here, and unlit else (docs/shafts.md). Where the lit side is not lit, the wall is
// inside another shadow, and nothing.

#define ALPENGLOW_AIR_SET 2
#include "alpenglow/atmosphere.glsl"
#include "alpenglow/shafts.glsl"
#include "shafts/pixel_ray.glsl"
#include "sky/ray_light.glsl"
#include "shafts/air_ray.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in flat vec2 outward;

layout(location = 0) out vec4 sums;  // light; shadows entered less those left

void main() {
  vec3 at = alpenglowOnSunMap(position);
  // Silhouettes are jagged: of three texels outside, the one that sees farthest.
  vec2 beside = at.xy + outward, along = vec2(-outward.y, outward.x);
  float first = max(alpenglowFirstDepth(beside),
                    max(alpenglowFirstDepth(beside + along), alpenglowFirstDepth(beside - along)));
  bool divides = first > at.z;
  vec3 view;
  Ray ray = pixelRay(gl_FragCoord.xy, view);
  float t = kOrthographic ? dot(position, view) : length(position);
  bool reached = t > 0.0 && (!ray.hitsGround || t < ray.start + ray.extent);
  float sign_ = divides && reached ? (gl_FrontFacing ? 1.0 : -1.0) : 0.0;
  sums = vec4(sign_ * alpenglowAirSingle(airRayOf(ray, view), t), sign_);
}
