// The ray through a pixel of the frame that alpenglow/shafts.glsl tells of.

#include "common/observer.glsl"

Ray pixelRay(vec2 fragCoord, out vec3 view) {
  vec3 across = alpenglowPixelOffset(fragCoord);
  vec3 up = alpenglowShaft.upAltitude.xyz;
  float altitude = alpenglowShaft.upAltitude.w;
  view = alpenglowShaft.forwardNear.xyz;
  if (kOrthographic) alpenglowMoveObserver(across, up, altitude);
  else view = normalize(view + across);
  return alpenglowRay(up, altitude, view, alpenglowShaft.sunRange.xyz);
}
