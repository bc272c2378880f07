// Orthographic cameras: each pixel's ray has an observer of its own. Needs alpenglow/atmosphere.glsl.

layout(constant_id = 6) const bool kOrthographic = false;

// The vertical and the altitude `offset` metres from another observer.
void moveObserver(vec3 offset, inout vec3 up, inout float altitude) {
  float d = length(offset);
  vec3 there = up * (alpenglowMedium.bottomRadius + altitude) + offset;
  altitude = altitudeAt(alpenglowMedium, altitude, dot(offset, up) / max(d, 1e-9), d);
  up = normalize(there);
}
