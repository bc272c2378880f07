#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "H n": azimuthal modes of what aerosols scatter into each angle from the sun, of the light of order n.
#include "moment_common.glsl"

layout(set = 1, binding = 0, rgba32f) uniform writeonly image2D sourceModes;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  imageStore(sourceModes, texel.xy,
             vec4(sourceModeOfNode(shape, texel.x, texel.y), 0.0));
}
