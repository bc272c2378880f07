#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "dJ n": light scattered at a point by the event that makes order n, equation 7.
#include "common.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image3D deltaSource;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  ScatteringTexel s = scatteringTexel(texel);
  imageStore(deltaSource, texel,
             vec4(scatteringDensity(medium, shape, float(texel.x % int(shape.scatteringMuS)),
                                    float(texel.z), s.h, s.mu, s.muS, s.nu),
                  0.0));
}
