#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "J sum": what aerosols scatter of the light of all orders, over the mean radiance of "N sum".
// ALPENGLOW_NO_ORDER: none was solved, there is no light.
#include "moment_common.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image3D source;

#ifdef ALPENGLOW_NO_ORDER

Spectrum sumOfTexel(ivec3 texel) { return SPECTRUM(0.0); }

#else

layout(set = 0, binding = 4) uniform sampler3D sumTable;
layout(set = 0, binding = 5) uniform sampler2D lastTable;    // fields of the last two orders, plain
layout(set = 0, binding = 6) uniform sampler2D beforeTable;

Spectrum sumOfTexel(ivec3 texel) {
  Spectrum last = fetchLayer(lastTable, texel.yz, 0);
  Spectrum tail = tailFactor(shape, last, fetchLayer(beforeTable, texel.yz, 0));
  Spectrum light = texelFetch(sourceTable, texel, 0).rgb *
                   sourceNorm(shape, texel.x, max(last, SPECTRUM(kMinRadiance)));
  Spectrum total = exp(fetchLayer(fieldTable, texel.yz, 0));
  return (texelFetch(sumTable, texel, 0).rgb + light * tail) /
         sourceNorm(shape, texel.x, total);
}

#endif

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  imageStore(source, texel, vec4(sumOfTexel(texel), 0.0));
}
