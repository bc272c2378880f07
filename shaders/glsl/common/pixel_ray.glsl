// The ray through a pixel of the frame that alpenglow/light_shafts.glsl describes.

#include "common/observer.glsl"

Ray pixelRay(vec2 fragCoord, out vec3 view) {
  vec3 across = alpenglowPixelOffset(fragCoord);
  vec3 up = alpenglowLightShaft.upAltitude.xyz;
  float altitude = alpenglowLightShaft.upAltitude.w;
  view = alpenglowLightShaft.forwardNear.xyz;
  if (kOrthographic) alpenglowMoveObserver(across, up, altitude);
  else view = normalize(view + across);
  return alpenglowRay(up, altitude, view, alpenglowLightShaft.sunRange.xyz);
}
