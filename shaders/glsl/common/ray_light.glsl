// Light of the air up to any point of a pixel's ray: from this frame's air volume (ALPENGLOW_FROM_VOLUME), or
// by integration through the tables. Distances are metres from the observer, cut at the end of the ray.

#ifdef ALPENGLOW_FROM_VOLUME
#include "common/air_volume.glsl"
#else
struct AirRay {
  Ray ray;
};
struct AirLight {
  Spectrum single;
  Spectrum multiple;
  Spectrum depth;
};

AirLight alpenglowAirLight(AirRay air, float distance_) {
  float inside = alpenglowInside(air.ray, distance_);
  AirLight light;
#ifndef ALPENGLOW_PATH_LIGHT
  Spectrum transmittance;
  light.single = SPECTRUM(0.0);  // all orders come in one
  light.multiple = alpenglowRadianceToPoint(air.ray, distance_, transmittance);
  light.depth = -log(max(transmittance, SPECTRUM(1e-30)));
#else
  PathLight path = alpenglowPathLight(air.ray, inside);
  light.multiple = path.multiple;
  path.multiple = SPECTRUM(0.0);
  light.single = radianceOfPath(alpenglowMedium, path, air.ray.nu);
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
Spectrum alpenglowAirSingle(AirRay air, float distance_) {
  float inside = alpenglowInside(air.ray, distance_);
  PathLight light = lightOfPath(alpenglowMedium, alpenglowShape, air.ray, inside,
                                alpenglowViewPanels(), true, false);
  return inside > 0.0 ? radianceOfPath(alpenglowMedium, light, air.ray.nu) : SPECTRUM(0.0);
}
#endif
#endif
