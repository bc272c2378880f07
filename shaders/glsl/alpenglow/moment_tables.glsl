// The tables of Solver::Moments: a part of alpenglow/atmosphere.glsl.

#define ALPENGLOW_PATH_LIGHT  // single and multiple scattering of a ray are separate

layout(set = ALPENGLOW_SET, binding = 1) uniform sampler2D alpenglowDepthTable;
Spectrum readDepth(vec2 uv) { return textureLod(alpenglowDepthTable, uv, 0.0).rgb; }
#ifdef ALPENGLOW_WITHOUT_MULTIPLE
#define ALPENGLOW_MULTIPLE false
#else
#define ALPENGLOW_MULTIPLE true
layout(set = ALPENGLOW_SET, binding = 2) uniform sampler2D alpenglowMomentsTable;
Spectrum readMoments(vec2 uv) { return textureLod(alpenglowMomentsTable, uv, 0.0).rgb; }
#ifndef ALPENGLOW_WITHOUT_SOURCE
layout(set = ALPENGLOW_SET, binding = 3) uniform sampler3D alpenglowSourceTable;
Spectrum readSource(vec3 uvw) { return textureLod(alpenglowSourceTable, uvw, 0.0).rgb; }
#endif
#endif

#include "physics/field_lookup.glsl"
#include "physics/inscattering.glsl"

layout(set = ALPENGLOW_SET, binding = 0, std140) uniform AlpenglowAtmosphere {
  Medium alpenglowMedium;
  MomentShape alpenglowShape;
};

// Mesa's software driver treats a uniform that bounds a loop as a constant: each time the uniform is bound, it
// compiles and keeps another shader. It doesn't where a texture's size is part of the bound; the term is always 0.
int alpenglowViewPanels() {
  return int(alpenglowShape.viewPanels) + (textureSize(alpenglowDepthTable, 0).x >> 24);
}

PathLight alpenglowPathLight(Ray ray, float inside) {
  return integrateInscattering(alpenglowMedium, alpenglowShape, ray, inside, alpenglowViewPanels(),
                               true, ALPENGLOW_MULTIPLE);
}

Spectrum alpenglowLightOfSegment(Ray ray, float inside, Spectrum transmittance) {
  return radianceOfPath(alpenglowMedium, alpenglowPathLight(ray, inside), ray.nu);
}

Spectrum alpenglowLightOfRay(Ray ray) {
  return alpenglowLightOfSegment(ray, ray.extent, SPECTRUM(0.0));
}

Spectrum alpenglowSunlight(float altitude, float muS) {
  return sunlight(alpenglowMedium, alpenglowShape, altitude, muS);
}

Spectrum alpenglowSkyIrradiance(float altitude, float muS) {
  Spectrum e = SPECTRUM(0.0);
  if (ALPENGLOW_GROUND_IRRADIANCE) e = fieldIrradiance(alpenglowMedium, alpenglowShape, altitude, muS);
  return e;
}

Spectrum alpenglowTransmittanceOfRay(Ray ray) {
  return exp(-depthTowardsTop(alpenglowMedium, alpenglowShape, ray.h, ray.mu));
}
