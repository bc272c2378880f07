#version 460
#extension GL_GOOGLE_include_directive : require
// The standard solver's sky-view LUT: the slice of S at the camera. r and mu_s are the same for all pixels, so
// they are interpolated here once, for each mu and nu of the table.

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool kMiePacked = false;

#define ALPENGLOW_SOLVER_STANDARD
#define ALPENGLOW_MIE_PACKED kMiePacked
#include "alpenglow/atmosphere.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image2D skyView;
layout(set = 1, binding = 1, ALPENGLOW_STORAGE) uniform writeonly image2D skyViewMie;

layout(push_constant) uniform Camera {
  float altitude;
  float muS;
};

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(skyView)))) return;
  float uMuS = insetCoordinate(scatteringUmuS(muS), alpenglowShape.scatteringMuS);
  float uR = insetCoordinate(scatteringUr(alpenglowMedium, altitude), alpenglowShape.scatteringR);
  vec3 at = vec3((float(texel.x) + uMuS) / alpenglowShape.scatteringNu,
                 (float(texel.y) + 0.5) / alpenglowShape.scatteringMu, uR);
  imageStore(skyView, texel, readScattering(at));
  if (!kMiePacked) imageStore(skyViewMie, texel, vec4(readSingleMie(at), 0.0));
}
