#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "N n": mean radiance, second moments and irradiance of order n: encoded, plain, and
// summed up over the orders. An invocation makes the five layers of a node.
#include "moment_common.glsl"

layout(set = 1, binding = 0, rgba32f) uniform writeonly image2D field;
layout(set = 1, binding = 1, rgba32f) uniform writeonly image2D plainField;
layout(set = 1, binding = 2, rgba32f) uniform image2D sum;

void add(NodeField node, int layer, ivec2 texel) {
  texel.y += layer * int(shape.nodesR);
  vec4 plain = vec4(plainLayer(node, layer), 0.0);
  imageStore(field, texel, vec4(encodeLayer(node, layer), 0.0));
  imageStore(plainField, texel, plain);
  imageStore(sum, texel, kFirstOrder ? plain : imageLoad(sum, texel) + plain);
}

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  NodeField node = fieldOfNode(medium, shape, nodeOf(texel.x, texel.y), kFirstOrder);
  for (int layer = 0; layer < int(shape.layers); ++layer) add(node, layer, texel.xy);
}
