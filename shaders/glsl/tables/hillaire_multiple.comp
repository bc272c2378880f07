#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "Psi" of Hillaire 2020: multiple scattering, equations 5 to 10.
#include "common.glsl"
#include "baselines/baseline.glsl"
#include "baselines/hillaire.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image2D multiple;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  vec2 hMuS = multipleHMuS(medium, vec2(texelToU(float(texel.x), float(width)),
                                        texelToU(float(texel.y), float(height))));
  imageStore(multiple, texel.xy, vec4(multipleScattering(medium, shape, hMuS.x, hMuS.y), 0.0));
}
