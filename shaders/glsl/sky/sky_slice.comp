#version 460
#extension GL_GOOGLE_include_directive : require
// The sky slice of one frame (physics/slice.glsl): light that arrives at the camera along each ray.

layout(local_size_x = 8, local_size_y = 8) in;

#include "common/effect_constants.glsl"

#include "alpenglow/atmosphere.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image2D slice;
layout(set = 1, binding = 1, ALPENGLOW_STORAGE) uniform writeonly image2D sliceMie;

layout(constant_id = 11) const float kSliceColumns = 128.0;
layout(constant_id = 12) const float kSliceRows = 160.0;

layout(push_constant) uniform Camera {
  float altitude;
  float muS;
  float horizon, span, bend;  // SliceView
};

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);  // the image is whole groups
  SliceView view = SliceView(horizon, span, bend);
  Ray ray = gridRay(alpenglowMedium, sliceGrid(view, kSliceColumns, kSliceRows), view, altitude, muS, float(texel.x),
                    float(texel.y));
  PathLight light = alpenglowPathLight(ray, ray.extent);
  Spectrum logarithm, mieShare;
  Spectrum smooth_ = light.multiple;
  if (ALPENGLOW_RAYLEIGH) smooth_ += light.rayleigh * rayleighPhase(ray.nu);
  encodeSlice(smooth_, light.mie, logarithm, mieShare);
  imageStore(slice, texel, vec4(logarithm, 0.0));
  if (ALPENGLOW_MIE) imageStore(sliceMie, texel, vec4(mieShare, 0.0));
}
