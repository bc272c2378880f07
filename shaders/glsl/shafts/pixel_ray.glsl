// The ray through a pixel of the frame that alpenglow/shafts.glsl tells of.

#include "sky/observer.glsl"

Ray pixelRay(vec2 fragCoord, out vec3 view) {
  vec2 ndc = (fragCoord - vec2(alpenglowShaft.rightOffsetX.w, alpenglowShaft.downOffsetY.w)) *
                 alpenglowShaft.pixels.xy - 1.0;
  vec3 across = ndc.x * alpenglowShaft.rightOffsetX.xyz + ndc.y * alpenglowShaft.downOffsetY.xyz;
  vec3 up = alpenglowShaft.upAltitude.xyz;
  float altitude = alpenglowShaft.upAltitude.w;
  view = alpenglowShaft.forwardNear.xyz;
  if (kOrthographic) alpenglowMoveObserver(across, up, altitude);
  else view = normalize(view + across);
  return alpenglowRay(up, altitude, view, alpenglowShaft.sunRange.xyz);
}
