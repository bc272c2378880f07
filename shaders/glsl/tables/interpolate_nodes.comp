#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "I n": the field of order n between the nodes, as lookups read it. An invocation makes a texel of one
// layer.
#include "moment_common.glsl"

layout(set = 1, binding = 0, rgba32f) uniform writeonly image2D field;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  int layer = texel.y / int(shape.fieldR);
  int row = texel.y - layer * int(shape.fieldR);
  Spectrum value = interpolatedNode(shape, texel.x, row, layer * int(shape.nodesR));
  imageStore(field, texel.xy, vec4(value, 0.0));
}
