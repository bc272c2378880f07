// The tables of Solver::Standard: a part of alpenglow/atmosphere.glsl.

layout(set = ALPENGLOW_SET, binding = 1) uniform sampler2D alpenglowTransmittanceTable;
layout(set = ALPENGLOW_SET, binding = 2) uniform sampler2D alpenglowIrradiance;
layout(set = ALPENGLOW_SET, binding = 3) uniform sampler3D alpenglowScattering;
layout(set = ALPENGLOW_SET, binding = 4) uniform sampler3D alpenglowSingleMie;

Spectrum readTransmittance(vec2 uv) {
  return textureLod(alpenglowTransmittanceTable, uv, 0.0).rgb;
}
Spectrum readIrradiance(vec2 uv) { return textureLod(alpenglowIrradiance, uv, 0.0).rgb; }
vec4 readScattering(vec3 uvw) { return textureLod(alpenglowScattering, uvw, 0.0); }
Spectrum readSingleMie(vec3 uvw) { return textureLod(alpenglowSingleMie, uvw, 0.0).rgb; }

#include "physics/lookup.glsl"

layout(set = ALPENGLOW_SET, binding = 0, std140) uniform AlpenglowAtmosphere {
  Medium alpenglowMedium;
  TableShape alpenglowShape;
};

Spectrum alpenglowLightOfRay(Ray ray) {
  return scatteringOfRay(alpenglowMedium, alpenglowShape, ray.h, ray.mu, ray.muS, ray.nu,
                         ray.hitsGround);
}

Spectrum alpenglowLightOfSegment(Ray ray, float inside, Spectrum transmittance) {
  return scatteringOfSegment(alpenglowMedium, alpenglowShape, ray, inside, transmittance);
}

Spectrum alpenglowSunlight(float altitude, float muS) {
  return transmittanceToSun(alpenglowMedium, alpenglowShape, altitude, muS);
}

Spectrum alpenglowSkyIrradiance(float altitude, float muS) {
  return skyIrradiance(alpenglowMedium, alpenglowShape, altitude, muS);
}

Spectrum alpenglowTransmittanceOfRay(Ray ray) {
  return transmittanceToTop(alpenglowMedium, alpenglowShape, ray.h, ray.mu);
}
