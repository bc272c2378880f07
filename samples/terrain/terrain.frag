#version 460
#extension GL_GOOGLE_include_directive : require
// Terrain as a host shades it: a Lambertian surface in sunlight and sky light, linear radiance, without the
// aerial perspective in front of it, which recordAerialPerspective draws over it.
#include "alpenglow/atmosphere.glsl"
#ifdef WITH_LIGHT_SHAFTS
#define ALPENGLOW_LIGHT_SHAFT_SET 3
#include "alpenglow/light_shafts.glsl"
#endif
#include "scene_frame.glsl"
#include "surface_light.glsl"

layout(set = 2, binding = 0) uniform sampler2D albedoMap;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 0) out vec4 color;

void main() {
  vec3 up;
  float altitude;
  atPoint(position, up, altitude);
  vec3 n = normalize(normal);
  float facing = max(dot(n, frame.sun.xyz), 0.0);
#ifdef WITH_LIGHT_SHAFTS
  facing *= alpenglowSunlit(gl_FragCoord, position, n);
#endif
  Spectrum albedo = texture(albedoMap, uv).rgb;
  color = vec4(albedo / kPi * surfaceIrradiance(up, altitude, n, facing) * frame.irradiance.rgb, 1.0);
}
