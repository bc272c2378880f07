// Light of the atmosphere up to any point of a pixel's ray: from this frame's aerial-perspective LUT
// (ALPENGLOW_FROM_AERIAL_PERSPECTIVE_LUT), or by integration through the tables. Distances are metres from the
// observer, limited to the end of the ray.

#ifdef ALPENGLOW_FROM_AERIAL_PERSPECTIVE_LUT
#include "common/aerial_perspective_lut.glsl"
#else
struct AerialRay {
  Ray ray;
};
struct AerialLight {
  Spectrum single;
  Spectrum multiple;
  Spectrum depth;
};

AerialLight alpenglowAerialLight(AerialRay aerial, float distance_) {
  float inside = alpenglowInside(aerial.ray, distance_);
  AerialLight light;
#ifndef ALPENGLOW_PATH_LIGHT
  Spectrum transmittance;
  light.single = SPECTRUM(0.0);  // single and multiple scattering are not separate
  light.multiple = alpenglowRadianceToPoint(aerial.ray, distance_, transmittance);
  light.depth = -log(max(transmittance, SPECTRUM(1e-30)));
#else
  PathLight path = alpenglowPathLight(aerial.ray, inside);
  light.multiple = path.multiple;
  path.multiple = SPECTRUM(0.0);
  light.single = radianceOfPath(alpenglowMedium, path, aerial.ray.nu);
  light.depth = path.depth;
#endif
  if (inside <= 0.0) {
    light.single = SPECTRUM(0.0);
    light.multiple = SPECTRUM(0.0);
    light.depth = SPECTRUM(0.0);
  }
  return light;
}

#ifdef ALPENGLOW_PATH_LIGHT
Spectrum alpenglowAerialSingle(AerialRay aerial, float distance_) {
  float inside = alpenglowInside(aerial.ray, distance_);
  PathLight light = integrateInscattering(alpenglowMedium, alpenglowShape, aerial.ray, inside,
                                          alpenglowViewPanels(), true, false);
  return inside > 0.0 ? radianceOfPath(alpenglowMedium, light, aerial.ray.nu) : SPECTRUM(0.0);
}
#endif
#endif
