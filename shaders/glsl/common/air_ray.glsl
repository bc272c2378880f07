// A ray from this frame's camera, ready for common/ray_light.glsl.

AerialRay aerialRayOf(Ray ray, vec3 view) {
#ifdef ALPENGLOW_FROM_AERIAL_PERSPECTIVE_LUT
  vec4 s = alpenglowLightShaft.aerialSkyView;
  AerialView aerial = AerialView(SkyViewParams(s.x, s.y, s.z), s.w, alpenglowLightShaft.aerialSun.w,
                                 alpenglowLightShaft.aerialHeight.x);
  return alpenglowAerialRay(aerial, alpenglowLightShaft.upAltitude.xyz, alpenglowLightShaft.aerialSun.xyz, ray, view);
#else
  return AerialRay(ray);
#endif
}
