#version 460
#extension GL_GOOGLE_include_directive : require
// A star's light: its irradiance times transmittance, spread over 3 x 3 pixels so that the sum of radiance times
// solid angle is the same wherever between the pixels the star stands, and however large they are.
#include "alpenglow/atmosphere.glsl"
#include "stars.glsl"

layout(location = 0) flat in vec3 direction;
layout(location = 1) flat in vec2 center;
layout(location = 2) flat in float share;
layout(location = 0) out vec4 radiance;

// The quadratic B-spline, 3 wide: its values at points 1 apart sum to 1.
float spline(float x) {
  float a = abs(x);
  float outer = max(1.5 - a, 0.0);
  return a < 0.5 ? 0.75 - a * a : 0.5 * outer * outer;
}

// Of the pixel `at` pixels from the middle of the picture: what its square covers of the sphere.
float solidAngle(vec2 at) {
  vec2 angle = at / view.downFocal.w;
  float pixel = 1.0 / (view.downFocal.w * view.downFocal.w);
  float theta = length(angle);
  if (view.forwardFisheye.w > 0.0) return pixel * (theta > 1e-3 ? sin(theta) / theta : 1.0);
  return pixel * pow(1.0 + theta * theta, -1.5);
}

void main() {
  vec2 at = gl_FragCoord.xy - view.viewport.xy - 0.5 * view.viewport.zw;
  float weight = spline(at.x - center.x) * spline(at.y - center.y);
  // The sun has no effect on transmittance.
  Ray ray = alpenglowRay(view.up.xyz, view.rightAltitude.w, direction, view.up.xyz);
  Spectrum light = alpenglowTransmittanceToSpace(ray) * view.irradiance.rgb;
  radiance = vec4(light * (share * weight / solidAngle(at)), 0.0);
}
