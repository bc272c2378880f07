#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "T": -ln T towards the top, equation 5. Kept as an optical depth, in 32 bits where the device
// can filter them: the solver and the renderer take differences of it.
#include "common.glsl"

layout(set = 1, binding = 0, ALPENGLOW_OPTICAL_DEPTH_STORAGE) uniform writeonly image2D opticalDepth;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  vec2 hMu = transmittanceHMu(medium, vec2(unitFromTexel(float(texel.x), shape.transmittanceMu),
                                           unitFromTexel(float(texel.y), shape.transmittanceR)));
  Spectrum depth = opticalDepthToTop(medium, hMu.x, hMu.y, kTransmittanceTrapezoids);
  // Half floats end at 65504; nothing is seen through that much air.
  imageStore(opticalDepth, texel.xy, vec4(min(depth, SPECTRUM(6e4)), 0.0));
}
