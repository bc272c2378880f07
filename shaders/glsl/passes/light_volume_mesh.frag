#version 460
#extension GL_GOOGLE_include_directive : require
// A crossing of a view ray with the light-volume mesh: adds the single scattering of all that lies before it if
// the ray enters shadow here, and subtracts it otherwise (docs/light-shafts.md).

#define ALPENGLOW_AERIAL_PERSPECTIVE_SET 2
#include "common/effect_constants.glsl"
#include "alpenglow/atmosphere.glsl"
#include "alpenglow/light_shafts.glsl"
#include "common/pixel_ray.glsl"
#include "common/ray_light.glsl"
#include "common/air_ray.glsl"

layout(location = 0) in vec3 position;

layout(location = 0) out vec4 sums;  // light; shadows entered minus shadows left

void main() {
  vec3 view;
  Ray ray = pixelRay(gl_FragCoord.xy, view);
  float t = kOrthographic ? dot(position, view) : length(position);
  // The ground's sphere is in no depth image. Depth is clamped, so that an orthographic camera also draws what
  // lies behind the plane where its rays begin.
  bool reached = (!ray.hitsGround || t < ray.start + ray.extent) && !(kOrthographic && t < 0.0);
  // The strips show their fronts to the light.
  float sign_ = reached ? (gl_FrontFacing ? 1.0 : -1.0) : 0.0;
  sums = vec4(sign_ * alpenglowAerialSingle(aerialRayOf(ray, view), t), sign_);
}
