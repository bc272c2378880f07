#version 460
#extension GL_GOOGLE_include_directive : require
// A host's own shader: it includes Alpenglow's functions and binds the tables at set 2.

layout(local_size_x = 8) in;

#define ALPENGLOW_SET 2
#include "alpenglow/atmosphere.glsl"

struct Question {
  vec4 upAltitude;
  vec4 viewDistance;
  vec4 sun;
};
struct Answer {
  vec4 whole;          // radiance of the atmosphere along the whole ray
  vec4 toPoint;        // and to a point of it
  vec4 transmittance;  // to that point
  vec4 toSpace;        // transmittance to what lies beyond the atmosphere
  vec4 direct;
  vec4 sky;
};

layout(set = 0, binding = 0, std430) readonly buffer Questions { Question questions[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Answers { Answer answers[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= questions.length()) return;
  Question q = questions[i];
  Ray ray = alpenglowRay(q.upAltitude.xyz, q.upAltitude.w, q.viewDistance.xyz, q.sun.xyz);
  Spectrum transmittance, direct, sky;
  answers[i].whole = vec4(alpenglowSkyRadiance(ray), 0.0);
  answers[i].toPoint = vec4(alpenglowRadianceToPoint(ray, q.viewDistance.w, transmittance), 0.0);
  answers[i].transmittance = vec4(transmittance, 0.0);
  answers[i].toSpace = vec4(alpenglowTransmittanceToSpace(ray), 0.0);
  alpenglowSunAndSkyIrradiance(q.upAltitude.w, dot(q.upAltitude.xyz, q.sun.xyz), direct, sky);
  answers[i].direct = vec4(direct, 0.0);
  answers[i].sky = vec4(sky, 0.0);
}
