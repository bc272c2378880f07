#version 460
#extension GL_GOOGLE_include_directive : require
// Translucent cloth at any depth: shaded, then given the aerial perspective in front of it, then blended over the
// picture, which has aerial perspective already.
#ifdef ALPENGLOW_SOLVER_STANDARD
layout(constant_id = 0) const bool kMiePacked = false;
#define ALPENGLOW_MIE_PACKED kMiePacked
#endif
#include "alpenglow/atmosphere.glsl"
#ifdef WITH_LIGHT_SHAFTS
#define ALPENGLOW_LIGHT_SHAFT_SET 3
#include "alpenglow/light_shafts.glsl"
#endif
#include "scene_frame.glsl"
#include "surface_light.glsl"
#include "balloon.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float gore;
layout(location = 0) out vec4 color;

// The ray from the camera, or from the plane through it, to the point; returns its length.
float rayToPoint(out Ray ray) {
  vec3 up = frame.upAltitude.xyz, view = frame.forwardParallel.xyz;
  float altitude = frame.upAltitude.w, far = dot(position, view);
  if (frame.forwardParallel.w > 0.5) {
    alpenglowMoveObserver(position - far * view, up, altitude);
  } else {
    far = length(position);
    view = position / far;
  }
  ray = alpenglowRay(up, altitude, view, frame.sun.xyz);
  return far;
}

void main() {
  Ray ray;
  float far = rayToPoint(ray);
  bool behindGround = ray.hitsGround && far > ray.start + ray.extent;
  vec3 up;
  float altitude;
  atPoint(position, up, altitude);
  vec3 n = normalize(normal);
  float toSun = dot(n, frame.sun.xyz);
  float facing = toSun > 0.0 ? toSun : -0.4 * toSun;  // Cloth lets light through.
#ifdef WITH_LIGHT_SHAFTS
  bool mapped = int(alpenglowLightShaft.pixels.z) != kShadowVolume;
  if (mapped) facing *= alpenglowSunShare(position);
#endif
  float seam = fract(0.5 * gore) < 0.5 ? 1.0 : 0.55;
  Spectrum cloth = seam * balloon.colorOpacity.rgb / kPi * surfaceIrradiance(up, altitude, n, facing);
  Spectrum transmittance;
  Spectrum air = alpenglowRadianceToPoint(ray, far, transmittance);
  color = vec4((cloth * transmittance + air) * frame.irradiance.rgb,
               behindGround ? 0.0 : balloon.colorOpacity.a);
}
