#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "L n": light of order n along the rays to each node, from the sources and the field of the order
// before.
#include "moment_common.glsl"

layout(set = 1, binding = 0, rgba32f) uniform writeonly image2D radiance;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  imageStore(radiance, texel.xy, vec4(multipleLight(medium, shape, texel.x, texel.y), 0.0));
}
