#version 460
#extension GL_GOOGLE_include_directive : require
// The sky-view LUT of one frame (physics/sky_view_lut.glsl): light that arrives at the camera along each ray.

layout(local_size_x = 8, local_size_y = 8) in;

#include "common/effect_constants.glsl"

#include "alpenglow/atmosphere.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image2D skyView;
layout(set = 1, binding = 1, ALPENGLOW_STORAGE) uniform writeonly image2D skyViewMie;

layout(constant_id = 11) const float kSkyViewColumns = 128.0;
layout(constant_id = 12) const float kSkyViewRows = 160.0;

layout(push_constant) uniform Camera {
  float altitude;
  float muS;
  float horizon, span, bend;  // SkyViewParams
};

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);  // the image is whole groups
  SkyViewParams view = SkyViewParams(horizon, span, bend);
  Ray ray = gridRay(alpenglowMedium, skyViewGrid(view, kSkyViewColumns, kSkyViewRows), view, altitude, muS,
                    float(texel.x), float(texel.y));
  PathLight light = alpenglowPathLight(ray, ray.extent);
  Spectrum logarithm, mieShare;
  Spectrum smooth_ = light.multiple;
  if (ALPENGLOW_RAYLEIGH) smooth_ += light.rayleigh * rayleighPhase(ray.nu);
  encodeSkyView(smooth_, light.mie, logarithm, mieShare);
  imageStore(skyView, texel, vec4(logarithm, 0.0));
  if (ALPENGLOW_MIE) imageStore(skyViewMie, texel, vec4(mieShare, 0.0));
}
