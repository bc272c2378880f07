// Single scattering up to any point of a pixel's ray: from this frame's air volume, or by integration through
// the tables.

#ifdef ALPENGLOW_AIR_VOLUME
// TODO
#else
Spectrum singleLightTo(Ray ray, vec3 view, float inside) {
  PathLight light = lightOfPath(alpenglowMedium, alpenglowShape, ray, inside,
                                int(alpenglowShape.viewPanels), true, false);
  return inside > 0.0 ? radianceOfPath(alpenglowMedium, light, ray.nu) : SPECTRUM(0.0);
}
#endif
