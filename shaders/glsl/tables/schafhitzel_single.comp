#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "S" of Schafhitzel 2007: single scattering over (r, mu, mu_s), Rayleigh and Mie apart and without phase
// functions; the quadrature is the standard solver's.
#include "common.glsl"
#include "baselines/schafhitzel.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image3D rayleighTable;
layout(set = 1, binding = 1, ALPENGLOW_STORAGE) uniform writeonly image3D mieTable;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  ScatteringTexel s = scatteringTexel(texel);
  Spectrum rayleigh;
  Spectrum mie;
  singleScattering(medium, shape, s.h, s.mu, s.muS, tableNu(s.mu, s.muS), s.hitsGround, rayleigh, mie);
  Spectrum shorter = shorterRay(medium, shape, s.h, s.mu, s.hitsGround, s.reach);
  imageStore(rayleighTable, texel, vec4(rayleigh * shorter, 0.0));
  imageStore(mieTable, texel, vec4(mie * shorter, 0.0));
}
