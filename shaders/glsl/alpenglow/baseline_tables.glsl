// The tables of the simpler models: a part of alpenglow/atmosphere.glsl. Light and optical depth come from one
// march along a ray, except for Schafhitzel's model, which has a table of rays.

layout(set = ALPENGLOW_SET, binding = 1) uniform sampler2D alpenglowTransmittanceTable;
Spectrum readTransmittance(vec2 uv) { return textureLod(alpenglowTransmittanceTable, uv, 0.0).rgb; }

#include "physics/lookup.glsl"
#include "baselines/baseline.glsl"

layout(set = ALPENGLOW_SET, binding = 0, std140) uniform AlpenglowAtmosphere {
  Medium alpenglowMedium;
  TableShape alpenglowShape;
  BaselineSettings alpenglowSettings;
};

#if defined(ALPENGLOW_SOLVER_ONEIL)
#define ALPENGLOW_MARCHES
#include "baselines/oneil.glsl"

BaselineLight alpenglowMarch(Ray ray, float inside) {
  return oneilLight(alpenglowMedium, alpenglowShape, ray, inside, alpenglowSettings.stepCount);
}

#elif defined(ALPENGLOW_SOLVER_HILLAIRE)
#define ALPENGLOW_MARCHES
#define ALPENGLOW_MULTIPLE_READS
layout(set = ALPENGLOW_SET, binding = 2) uniform sampler2D alpenglowMultipleTable;
Spectrum readMultiple(vec2 uv) { return textureLod(alpenglowMultipleTable, uv, 0.0).rgb; }
#include "baselines/hillaire.glsl"

BaselineLight alpenglowMarch(Ray ray, float inside) {
  return hillaireLight(alpenglowMedium, alpenglowShape, ray, inside, alpenglowSettings.stepCount);
}

#elif defined(ALPENGLOW_SOLVER_HOFFMAN_PREETHAM)
#define ALPENGLOW_MARCHES
#include "baselines/hoffman_preetham.glsl"

BaselineLight alpenglowMarch(Ray ray, float inside) {
  return hoffmanPreethamOfRay(alpenglowMedium, ray, inside);
}

#else
#define ALPENGLOW_RAY_READS
layout(set = ALPENGLOW_SET, binding = 2) uniform sampler3D alpenglowRayleighTable;
layout(set = ALPENGLOW_SET, binding = 3) uniform sampler3D alpenglowMieTable;
Spectrum readScatteringRayleigh(vec3 uvw) { return textureLod(alpenglowRayleighTable, uvw, 0.0).rgb; }
Spectrum readScatteringMie(vec3 uvw) { return textureLod(alpenglowMieTable, uvw, 0.0).rgb; }
#include "baselines/schafhitzel.glsl"
#endif

#ifdef ALPENGLOW_MARCHES
Spectrum alpenglowLightOfSegment(Ray ray, float inside, Spectrum transmittance) {
  return alpenglowMarch(ray, inside).light;
}

Spectrum alpenglowLightOfRay(Ray ray) { return alpenglowMarch(ray, ray.extent).light; }
#else
Spectrum alpenglowLightOfSegment(Ray ray, float inside, Spectrum transmittance) {
  return schafhitzelOfSegment(alpenglowMedium, alpenglowShape, ray, inside, transmittance);
}

Spectrum alpenglowLightOfRay(Ray ray) {
  return schafhitzelOfRay(alpenglowMedium, alpenglowShape, ray.h, ray.mu, ray.muS, ray.nu,
                          ray.hitsGround);
}
#endif

// Sunlight, and sky light on a horizontal surface: with Hillaire that of isotropic light of mean radiance
// Psi_ms; with the others 0.
Spectrum alpenglowSunlight(float altitude, float muS) {
#ifdef ALPENGLOW_SOLVER_HOFFMAN_PREETHAM
  return exp(-depthThroughAtmosphere(alpenglowMedium, muS)) * sunVisibility(alpenglowMedium, altitude, muS);
#else
  return transmittanceToSun(alpenglowMedium, alpenglowShape, altitude, muS);
#endif
}

Spectrum alpenglowSkyIrradiance(float altitude, float muS) {
#ifdef ALPENGLOW_SOLVER_HILLAIRE
  return ALPENGLOW_PI * multipleFromTable(alpenglowMedium, altitude, muS);
#else
  return SPECTRUM(0.0);
#endif
}

Spectrum alpenglowTransmittanceOfRay(Ray ray) {
#ifdef ALPENGLOW_SOLVER_HOFFMAN_PREETHAM
  return exp(-depthThroughAtmosphere(alpenglowMedium, ray.mu));
#else
  return transmittanceToTop(alpenglowMedium, alpenglowShape, ray.h, ray.mu);
#endif
}
