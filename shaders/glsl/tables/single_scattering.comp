#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "dS 1": S[L0], equation 11 for one event, Rayleigh and Mie apart and without phase functions.
#include "common.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image3D deltaScattering;
layout(set = 1, binding = 1, ALPENGLOW_STORAGE) uniform writeonly image3D deltaMie;
layout(set = 1, binding = 2, ALPENGLOW_STORAGE) uniform writeonly image3D scattering;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  ScatteringTexel s = scatteringTexel(texel);
  Spectrum rayleigh;
  Spectrum mie;
  singleScattering(medium, shape, s.h, s.mu, s.muS, s.nu, s.hitsGround, rayleigh, mie);
  Spectrum shorter = shorterRay(medium, shape, s.h, s.mu, s.hitsGround, s.reach);
  rayleigh *= shorter;
  mie *= shorter;
  imageStore(deltaScattering, texel, vec4(rayleigh, 0.0));
  imageStore(deltaMie, texel, vec4(mie, 0.0));
  imageStore(scattering, texel, vec4(rayleigh, kMiePacked ? mie[0] : 0.0));
}
