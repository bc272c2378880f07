#version 460
#extension GL_GOOGLE_include_directive : require
// The aerial-perspective LUT and, beside it, the integral that it stands for, taken with many panels: for a
// direction and a distance each.

layout(local_size_x = 64) in;
layout(constant_id = 0) const int kWhat = 0;  // AerialAsk of aerial_perspective_fixture.h

#include "alpenglow/atmosphere.glsl"
#include "common/aerial_perspective_lut.glsl"

layout(set = 2, binding = 0, std430) readonly buffer Queries { vec4 queries[]; };
struct Answer {
  vec4 single, multiple, depth, singleAlone;
  vec4 wantedSingle, wantedMultiple, wantedDepth;
};
layout(set = 2, binding = 1, std430) writeonly buffer Answers { Answer answers[]; };

// Mirrored by LookupConstants in aerial_perspective_fixture.h.
layout(push_constant) uniform Draw {
  vec4 upAltitude;
  vec4 sunCount;        // w: queries
  vec4 azimuthHorizon;  // AerialView from here on
  vec4 rest;            // span, bend, extinction, startHeight
  float height;
};

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(sunCount.w)) return;
  vec3 view = queries[i].xyz;
  Ray ray = alpenglowRay(upAltitude.xyz, upAltitude.w, view, sunCount.xyz);
  // Metres in the atmosphere, or the negative share of the whole ray.
  float inside = queries[i].w < 0.0 ? -queries[i].w * ray.extent : queries[i].w;
  float distance_ = ray.start + inside;
  AerialView air = AerialView(SkyViewParams(azimuthHorizon.w, rest.x, rest.y), rest.z, rest.w, height);
  AerialRay aerialRay = alpenglowAerialRay(air, upAltitude.xyz, azimuthHorizon.xyz, ray, view);
  if (kWhat == 1) {
    AerialLight light = alpenglowAerialLight(aerialRay, distance_);
    answers[i].single = vec4(light.single + light.multiple + exp(-light.depth), 0.0);
    return;
  }
  if (kWhat == 2) {
    answers[i].single = vec4(alpenglowAerialSingle(aerialRay, distance_), 0.0);
    return;
  }
  if (kWhat == 3) {
    answers[i].single = queries[i] * distance_;
    return;
  }
  AerialLight light = alpenglowAerialLight(aerialRay, distance_);
  answers[i].single = vec4(light.single, alpenglowInside(ray, distance_));
  answers[i].multiple = vec4(light.multiple, 0.0);
  answers[i].depth = vec4(light.depth, 0.0);
  answers[i].singleAlone = vec4(alpenglowAerialSingle(aerialRay, distance_), 0.0);
  PathLight path =
      integrateInscattering(alpenglowMedium, alpenglowShape, ray, alpenglowInside(ray, distance_),
                            4 * int(alpenglowShape.viewPanels), true, true);
  bool any_ = ray.inAtmosphere;
  Spectrum single = path.rayleigh * rayleighPhase(ray.nu) +
                    path.mie * miePhase(alpenglowMedium.mieAsymmetry, ray.nu);
  answers[i].wantedSingle = vec4(any_ ? single : SPECTRUM(0.0), ray.hitsGround ? 1.0 : 0.0);
  answers[i].wantedMultiple = vec4(any_ ? path.multiple : SPECTRUM(0.0), ray.extent);
  answers[i].wantedDepth = vec4(any_ ? path.depth : SPECTRUM(0.0), ray.inAtmosphere ? 1.0 : 0.0);
}
