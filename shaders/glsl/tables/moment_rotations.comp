#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "W": what turns harmonics about the zenith into those about the sun, for each sun angle of the nodes.
#include "moment_common.glsl"

layout(set = 1, binding = 0, r32f) uniform writeonly image2D rotations;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  imageStore(rotations, texel.xy, vec4(rotationOfTexel(shape, texel.x, texel.y)));
}
