#version 460
#extension GL_GOOGLE_include_directive : require
// Hillaire's sky-view LUT of one frame: light that arrives at a camera inside the atmosphere, phase functions
// included.

layout(local_size_x = 8, local_size_y = 8) in;

#define ALPENGLOW_SOLVER_HILLAIRE
#include "alpenglow/atmosphere.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image2D skyView;

layout(constant_id = 11) const float kSkyViewColumns = 192.0;
layout(constant_id = 12) const float kSkyViewRows = 108.0;

layout(push_constant) uniform Camera {
  float altitude;
  float muS;
  float horizon;  // its angle from the nadir
};

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(skyView)))) return;
  Ray ray = skyViewRay(alpenglowMedium, horizon, altitude, muS, vec2(texel), vec2(kSkyViewColumns, kSkyViewRows));
  imageStore(skyView, texel, vec4(alpenglowMarch(ray, ray.extent).light, 0.0));
}
