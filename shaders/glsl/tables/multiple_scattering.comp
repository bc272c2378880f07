#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "dS n": the source of order n gathered along each ray, equation 11, added to S.
#include "common.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image3D deltaScattering;
layout(set = 1, binding = 1, ALPENGLOW_STORAGE) uniform image3D scattering;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  ScatteringTexel s = scatteringTexel(texel);
  Spectrum delta = multipleScattering(medium, shape, s.h, s.mu, s.muS, s.nu, s.hitsGround);
  delta *= shorterRay(medium, shape, s.h, s.mu, s.hitsGround, s.reach);
  imageStore(deltaScattering, texel, vec4(delta, 0.0));
  // The Rayleigh phase function is taken out, as equation C_* has it, and multiplied back at run time.
  imageStore(scattering, texel, imageLoad(scattering, texel) + vec4(delta / rayleighPhase(s.nu), 0.0));
}
