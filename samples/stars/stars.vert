#version 460
#extension GL_GOOGLE_include_directive : require
// Stars, without an index: three vertices for each, a triangle about the square of 3 x 3 pixels that the star's
// light falls on. What is outside of the picture, or behind the camera, becomes a triangle without area.
#include "stars.glsl"

layout(location = 0) in vec4 star;  // direction; irradiance over the sun's

layout(location = 0) flat out vec3 direction;
layout(location = 1) flat out vec2 center;  // from the middle of the picture, pixels
layout(location = 2) flat out float share;  // of the sun's irradiance

const vec2 kCorners[3] = vec2[](vec2(-1.5, -1.5), vec2(-1.5, 4.5), vec2(4.5, -1.5));

// Where in the picture; false: nowhere.
bool place(vec3 s, out vec2 at) {
  vec2 across = vec2(dot(view.rightAltitude.xyz, s), dot(view.downFocal.xyz, s));
  float ahead = dot(view.forwardFisheye.xyz, s);
  float half_ = view.forwardFisheye.w;
  if (half_ > 0.0) {
    float radius = length(across);
    float theta = atan(radius, ahead);
    at = across * (view.downFocal.w * (radius > 0.0 ? theta / radius : 1.0));
    return theta <= half_;
  }
  at = across * (view.downFocal.w / max(ahead, 1e-6));
  return ahead > 1e-6;
}

void main() {
  direction = star.xyz;
  share = star.w;
  bool seen = place(star.xyz, center);
  vec2 ndc = (center + kCorners[gl_VertexIndex % 3]) * 2.0 / view.viewport.zw;
  gl_Position = seen ? vec4(ndc, kFarDepth, 1.0) : vec4(2.0, 2.0, kFarDepth, 1.0);
}
