// The ray of a pixel, with alpenglow/atmosphere.glsl: from the camera, or from the plane through it.

// The observer at `offset` metres from another.
void moveObserver(vec3 up, float altitude, vec3 offset, out vec3 upThere, out float altitudeThere) {
  float d = length(offset);
  float mu = dot(offset, up) / max(d, 1e-9);
  altitudeThere = altitudeAt(alpenglowMedium, altitude, mu, d);
  upThere = normalize(up * (alpenglowMedium.bottomRadius + altitude) + offset);
}

layout(constant_id = 0) const bool kOrthographic = false;

// The ray through a pixel; `view` its direction.
Ray pixelRay(vec2 fragCoord, out vec3 view) {
  vec2 ndc = (fragCoord - vec2(alpenglowShaft.rightOffsetX.w, alpenglowShaft.downOffsetY.w)) *
                 alpenglowShaft.pixels.xy - 1.0;
  vec3 across = ndc.x * alpenglowShaft.rightOffsetX.xyz + ndc.y * alpenglowShaft.downOffsetY.xyz;
  vec3 forward = alpenglowShaft.forwardNear.xyz;
  vec3 up = alpenglowShaft.upAltitude.xyz;
  float altitude = alpenglowShaft.upAltitude.w;
  view = forward;
  if (kOrthographic) {
    moveObserver(up, altitude, across, up, altitude);
  } else {
    view = normalize(forward + across);
  }
  return alpenglowRay(up, altitude, view, alpenglowShaft.sunRange.xyz);
}
