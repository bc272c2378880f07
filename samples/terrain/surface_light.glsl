// Light that falls on a small surface of a host's scene. Needs alpenglow/atmosphere.glsl and
// scene_frame.glsl; per unit solar irradiance.

// The vertical and the altitude of a point, computed from the camera's without a difference of radii.
void atPoint(vec3 position, out vec3 up, out float altitude) {
  up = frame.upAltitude.xyz;
  altitude = frame.upAltitude.w;
  alpenglowMoveObserver(position, up, altitude);
}

// `facing`: cosine between normal and sun where the sun is visible, else 0. A tilted surface gets light from the
// ground in place of the hidden part of the sky.
Spectrum surfaceIrradiance(vec3 up, float altitude, vec3 normal, float facing) {
  float muS = dot(up, frame.sun.xyz);
  Spectrum sun, sky;
  alpenglowSunAndSkyIrradiance(min(altitude, alpenglowMedium.thickness), muS, sun, sky);
  Spectrum ground = kPi * alpenglowGroundRadiance(alpenglowMedium.groundAlbedo, muS);
  float lifted = 0.5 + 0.5 * dot(normal, up);
  return sun * facing + sky * lifted + ground * (1.0 - lifted);
}
