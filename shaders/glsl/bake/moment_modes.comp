#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "F n": azimuthal modes of the light of order n on each ring.
#include "moment_common.glsl"

layout(set = 1, binding = 0, rgba32f) uniform writeonly image2D modes;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  FourModes four = modesOfRing(medium, shape, texel.x, texel.y, kFirstOrder);
  int size = int(shape.degree) + 1;
  int ring = texel.x / modeGroups(shape);
  int mode = 4 * (texel.x - ring * modeGroups(shape));
  ivec2 at = ivec2(mode + size * ring, texel.y);
  imageStore(modes, at, vec4(four.a, 0.0));
  if (mode + 1 < size) imageStore(modes, at + ivec2(1, 0), vec4(four.b, 0.0));
  if (mode + 2 < size) imageStore(modes, at + ivec2(2, 0), vec4(four.c, 0.0));
  if (mode + 3 < size) imageStore(modes, at + ivec2(3, 0), vec4(four.d, 0.0));
}
