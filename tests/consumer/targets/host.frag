// A host's own shader: aerial perspective over something it has drawn.
#version 460
#extension GL_GOOGLE_include_directive : require
#define ALPENGLOW_SET 2
#include "alpenglow/atmosphere.glsl"

layout(push_constant) uniform Push {
  vec4 upAndAltitude;
  vec4 viewAndDistance;
  vec4 sun;
};
layout(location = 0) out vec4 color;

void main() {
  Ray ray = alpenglowRay(upAndAltitude.xyz, upAndAltitude.w, viewAndDistance.xyz, sun.xyz);
  vec3 transmittance;
  vec3 inscatter = alpenglowRadianceToPoint(ray, viewAndDistance.w, transmittance);
  color = vec4(vec3(0.5) * transmittance + inscatter, 1.0);
}
