#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "Q": nodes and weights of the quadrature in zenith angle. Row 1 is that of order 1.
#include "moment_common.glsl"

layout(set = 1, binding = 0, rgba32f) uniform writeonly image2D rules;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  bool used = texel.x < zenithCount(shape, texel.y == 0 ? 1 : kFineZeniths);
  vec2 rule = used ? zenithRule(shape, texel.x, texel.y) : vec2(0.0);
  imageStore(rules, texel.xy, vec4(rule, 0.0, 0.0));
}
