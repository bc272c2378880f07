#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "dE 1": E[L0], the sun's direct light on the ground. E itself, the sky's, starts at zero.
#include "common.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image2D deltaIrradiance;
layout(set = 1, binding = 1, ALPENGLOW_STORAGE) uniform writeonly image2D irradiance;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  vec2 hMuS = irradianceTexel(texel);
  imageStore(deltaIrradiance, texel.xy,
             vec4(directIrradiance(medium, shape, hMuS.x, hMuS.y), 0.0));
  imageStore(irradiance, texel.xy, vec4(0.0));
}
