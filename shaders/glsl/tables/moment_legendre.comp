#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "Y": Legendre functions of the zenith angles of each altitude, and of the sources' angles.
#include "moment_common.glsl"

layout(set = 1, binding = 0, r32f) uniform writeonly image2D functions;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  float value = legendreOfTexel(medium, shape, texel.x, texel.y);
  imageStore(functions, texel.xy, vec4(value));
}
