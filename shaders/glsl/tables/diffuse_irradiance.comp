#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "dE n": irradiance of the order before on the ground, equation 15, added to E.
#include "common.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image2D deltaIrradiance;
layout(set = 1, binding = 1, ALPENGLOW_STORAGE) uniform image2D irradiance;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  vec2 hMuS = irradianceTexel(texel);
  Spectrum delta = diffuseIrradiance(medium, shape, hMuS.x, hMuS.y);
  imageStore(deltaIrradiance, texel.xy, vec4(delta, 0.0));
  imageStore(irradiance, texel.xy, imageLoad(irradiance, texel.xy) + vec4(delta, 0.0));
}
