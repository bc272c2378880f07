#version 460
#extension GL_GOOGLE_include_directive : require
// Pass "dL n": radiance of the order before at the zenith angles of J's quadrature.
#include "common.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image2D incident;
layout(set = 1, binding = 1, ALPENGLOW_STORAGE) uniform writeonly image2D incidentMie;

void main() {
  ivec3 texel = tileTexel();
  if (texel.z < 0) return;
  int sizeNu = int(shape.scatteringNu);
  int sizeMuS = int(shape.scatteringMuS);
  float h = scatteringH(medium, texelToU(float(texel.y / sizeMuS), shape.scatteringR));
  float muS = scatteringMuS(texelToU(float(texel.y % sizeMuS), shape.scatteringMuS));
  float nu = 2.0 * texelToU(float(texel.x % sizeNu), shape.scatteringNu) - 1.0;
  Spectrum radiance;
  Spectrum mie;
  incidentRadiance(medium, shape, h, muS, nu, texel.x / sizeNu, radiance, mie);
  imageStore(incident, texel.xy, vec4(radiance, 0.0));
  if (kFirstOrder) imageStore(incidentMie, texel.xy, vec4(mie, 0.0));
}
