#version 460
#extension GL_GOOGLE_include_directive : require
// Point queries. The CPU has computed in double where a ray begins and ends; its light comes from the functions
// that the sky is drawn with.

layout(local_size_x = 64) in;
layout(constant_id = 0) const bool kMiePacked = false;

#define ALPENGLOW_MIE_PACKED kMiePacked
#include "common/effect_constants.glsl"
#include "alpenglow/atmosphere.glsl"

// Mirrored by PreparedQuery in atmosphere/passes/probe_pass.h.
struct Query {
  float h, mu, muS, nu;  // where the ray begins
  float d;               // metres along it
  float extent;          // metres to the ground or the top
  float muSGround;       // of the sun where it ends, if on the ground
  uint flags;
};
const uint kIrradiance = 1u;  // else a ray
const uint kHitsGround = 2u;  // the whole ray does
const uint kEndsOnGround = 4u;
const uint kEmpty = 8u;  // no atmosphere along the segment

struct Answer {
  vec4 transmittanceOrDirect;
  vec4 sky;
  vec4 ground;
  vec4 unused;
};

layout(set = 1, binding = 0, std430) readonly buffer Queries { Query queries[]; };
layout(set = 1, binding = 1, std430) writeonly buffer Answers { Answer answers[]; };
layout(push_constant) uniform Count { uint count; };

Answer irradianceAnswer(Query q) {
  Answer a;
  Spectrum sun;
  Spectrum sky;
  float inside = min(q.h, alpenglowMedium.thickness);
  alpenglowSunAndSkyIrradiance(inside, q.muS, sun, sky);
  bool above = (q.flags & kEmpty) != 0u;
  a.transmittanceOrDirect = vec4((above ? SPECTRUM(1.0) : sun) * max(q.muS, 0.0), 0.0);
  a.sky = vec4(above ? SPECTRUM(0.0) : sky, 0.0);
  a.ground = vec4(0.0);
  a.unused = vec4(0.0);
  return a;
}

Answer rayAnswer(Query q) {
  Answer a;
  Ray ray;
  ray.start = 0.0;
  ray.h = q.h;
  ray.mu = q.mu;
  ray.muS = q.muS;
  ray.nu = q.nu;
  ray.extent = q.extent;
  ray.hitsGround = (q.flags & kHitsGround) != 0u;
  ray.inAtmosphere = (q.flags & kEmpty) == 0u;
  Spectrum transmittance;
  Spectrum sky = alpenglowRadianceToPoint(ray, q.d, transmittance);
  Spectrum ground = transmittance * alpenglowGroundRadiance(alpenglowMedium.groundAlbedo, q.muSGround);
  a.transmittanceOrDirect = vec4(transmittance, 0.0);
  a.sky = vec4(sky, 0.0);
  a.ground = vec4((q.flags & kEndsOnGround) != 0u ? ground : SPECTRUM(0.0), 0.0);
  a.unused = vec4(0.0);
  return a;
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= count) return;
  Query q = queries[i];
  if ((q.flags & kIrradiance) != 0u) {
    answers[i] = irradianceAnswer(q);
  } else {
    answers[i] = rayAnswer(q);
  }
}
