#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "J n": what aerosols scatter of the light of order n - 1, as lookups read it, and its plain sum over
// the orders.
#include "moment_common.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image3D source;
layout(set = 1, binding = 1, rgba32f) uniform image3D sum;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  int node = nodeOf(texel.y, texel.z);
  Spectrum mean = exp(fetchLayer(fieldTable, texel.yz, 0));
  Spectrum light = sourceOfTexel(shape, texel.x, node);
  vec4 before = kFirstOrder ? vec4(0.0) : imageLoad(sum, texel);
  imageStore(sum, texel, before + vec4(light, 0.0));
  imageStore(source, texel, vec4(light / sourceNorm(shape, texel.x, mean), 0.0));
}
