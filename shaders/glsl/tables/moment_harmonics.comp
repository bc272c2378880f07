#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "M n": spherical harmonics of the light of order n at each node.
#include "moment_common.glsl"

layout(set = 1, binding = 0, rgba32f) uniform writeonly image2D moments;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  imageStore(moments, texel.xy,
             vec4(momentOfNode(shape, texel.x, texel.y, kFirstOrder), 0.0));
}
