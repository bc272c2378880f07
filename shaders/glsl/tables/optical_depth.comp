#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "T": -ln T towards the top, equation 5, encoded as lookup.glsl says. In 32 bits where the device
// can filter them: the solver and the renderer take differences of optical depths.
#include "common.glsl"

layout(set = 1, binding = 0, ALPENGLOW_OPTICAL_DEPTH_STORAGE) uniform writeonly image2D opticalDepth;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  vec2 hMu = transmittanceHMu(medium, vec2(texelToU(float(texel.x), shape.transmittanceMu),
                                           texelToU(float(texel.y), shape.transmittanceR)));
  Spectrum depth = tabulatedOpticalDepth(medium, shape, hMu.x, hMu.y);
  imageStore(opticalDepth, texel.xy, vec4(encodeOpticalDepth(depth), 0.0));
}
