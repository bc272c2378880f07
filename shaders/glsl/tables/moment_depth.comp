#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "T": optical depth towards the top of rays that rise, encoded as optical_depth.glsl says.
#include "moment_common.glsl"

layout(set = 1, binding = 0, rgba32f) uniform writeonly image2D opticalDepth;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  imageStore(opticalDepth, texel.xy, vec4(depthOfTexel(medium, shape, texel.x, texel.y), 0.0));
}
