#version 460
#extension GL_GOOGLE_include_directive : require
// The sky slice of one frame (physics/slice.glsl): light that arrives at the camera along each ray.

layout(local_size_x = 8, local_size_y = 8) in;

#include "alpenglow/atmosphere.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image2D slice;
layout(set = 1, binding = 1, ALPENGLOW_STORAGE) uniform writeonly image2D sliceMie;

layout(push_constant) uniform Camera {
  float altitude;
  float muS;
  float horizon, span, bend;  // SliceView
};

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);  // the image is whole groups
  SliceView view = SliceView(horizon, span, bend);
  float ground = sliceGroundRows(view);
  bool hitsGround = float(texel.y) < ground;
  float u = hitsGround ? unitFromTexel(float(texel.y), ground)
                       : unitFromTexel(float(texel.y) - ground, float(kSliceRows) - ground);
  float angle = sliceNadirAngle(view, u, hitsGround);
  float sineHalf = min(unitFromTexel(float(texel.x), sliceAzimuths(view)), 1.0);
  float mu = -cos(angle);
  float sine = sin(angle);
  float cosPhi = 1.0 - 2.0 * sineHalf * sineHalf;
  float nu = clamp(mu * muS + sine * sqrt(max(1.0 - muS * muS, 0.0)) * cosPhi, -1.0, 1.0);
  Ray ray = makeRay(alpenglowMedium, altitude, mu, sine, muS, nu);
  // The row says on which side of the horizon a ray lies, whatever its angle rounds to.
  ray.hitsGround = hitsGround;
  ray.extent = hitsGround ? distanceToGround(alpenglowMedium, ray.h, ray.mu)
                          : distanceToTop(alpenglowMedium, ray.h, ray.mu);
  PathLight light = alpenglowPathLight(ray, ray.extent);
  Spectrum logarithm, mieShare;
  encodeSlice(light.rayleigh * rayleighPhase(nu) + light.multiple, light.mie, logarithm, mieShare);
  imageStore(slice, texel, vec4(logarithm, 0.0));
  imageStore(sliceMie, texel, vec4(mieShare, 0.0));
}
