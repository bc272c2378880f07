#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "F n": azimuthal modes of the light of order n at each zenith angle.
#include "moment_common.glsl"

layout(set = 1, binding = 0, rgba32f) uniform writeonly image2D modes;

void put(Spectrum value, int mode, int zenith, int size, int node) {
  if (mode < size) imageStore(modes, ivec2(mode + size * zenith, node), vec4(value, 0.0));
}

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  EightModes eight = modesOfZenith(medium, shape, texel.x, texel.y, kFirstOrder);
  int size = int(shape.degree) + 1;
  int zenith = texel.x / modeGroups(shape);
  int mode = 8 * (texel.x - zenith * modeGroups(shape));
  put(eight.a, mode, zenith, size, texel.y);
  put(eight.b, mode + 1, zenith, size, texel.y);
  put(eight.c, mode + 2, zenith, size, texel.y);
  put(eight.d, mode + 3, zenith, size, texel.y);
  put(eight.e, mode + 4, zenith, size, texel.y);
  put(eight.f, mode + 5, zenith, size, texel.y);
  put(eight.g, mode + 6, zenith, size, texel.y);
  put(eight.h, mode + 7, zenith, size, texel.y);
}
