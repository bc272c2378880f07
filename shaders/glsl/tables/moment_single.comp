#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "L 1": single scattering along the rays to each node, without phase functions, and the ground's.
#include "moment_common.glsl"

layout(set = 1, binding = 0, rgba32f) uniform writeonly image2D radiance;
layout(set = 1, binding = 1, rgba32f) uniform writeonly image2D radianceMie;
layout(set = 1, binding = 2, rgba32f) uniform writeonly image2D radianceGround;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  Spectrum rayleigh;
  Spectrum mie;
  Spectrum ground;
  singleLight(medium, shape, texel.x, texel.y, rayleigh, mie, ground);
  imageStore(radiance, texel.xy, vec4(rayleigh, 0.0));
  // Without them another image is bound there.
  if (ALPENGLOW_MIE) imageStore(radianceMie, texel.xy, vec4(mie, 0.0));
  if (ALPENGLOW_GROUND_REFLECTION) imageStore(radianceGround, texel.xy, vec4(ground, 0.0));
}
