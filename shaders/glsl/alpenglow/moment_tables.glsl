// The tables of Solver::Moments: a part of alpenglow/atmosphere.glsl.

#define ALPENGLOW_PATH_LIGHT  // single and multiple scattering of a ray apart

layout(set = ALPENGLOW_SET, binding = 1) uniform sampler2D alpenglowDepthTable;
layout(set = ALPENGLOW_SET, binding = 2) uniform sampler2D alpenglowMomentsTable;
layout(set = ALPENGLOW_SET, binding = 3) uniform sampler3D alpenglowSourceTable;

Spectrum readDepth(vec2 uv) { return textureLod(alpenglowDepthTable, uv, 0.0).rgb; }
Spectrum readMoments(vec2 uv) { return textureLod(alpenglowMomentsTable, uv, 0.0).rgb; }
Spectrum readSource(vec3 uvw) { return textureLod(alpenglowSourceTable, uvw, 0.0).rgb; }

#include "physics/field_lookup.glsl"
#include "physics/path_light.glsl"

layout(set = ALPENGLOW_SET, binding = 0, std140) uniform AlpenglowAtmosphere {
  Medium alpenglowMedium;
  MomentShape alpenglowShape;
};

PathLight alpenglowPathLight(Ray ray, float inside) {
  return lightOfPath(alpenglowMedium, alpenglowShape, ray, inside, int(alpenglowShape.viewPanels),
                     true, true);
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
  return fieldIrradiance(alpenglowMedium, alpenglowShape, altitude, muS);
}

Spectrum alpenglowTransmittanceOfRay(Ray ray) {
  return exp(-depthTowardsTop(alpenglowMedium, alpenglowShape, ray.h, ray.mu));
}
