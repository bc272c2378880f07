// A ray from this frame's camera, ready for common/ray_light.glsl.

AirRay airRayOf(Ray ray, vec3 view) {
#ifdef ALPENGLOW_FROM_VOLUME
  vec4 s = alpenglowShaft.airSlice;
  AirView air = AirView(SliceView(s.x, s.y, s.z), s.w, alpenglowShaft.airSun.w, alpenglowShaft.airHeight.x);
  return alpenglowAirRay(air, alpenglowShaft.upAltitude.xyz, alpenglowShaft.airSun.xyz, ray, view);
#else
  return AirRay(ray);
#endif
}
