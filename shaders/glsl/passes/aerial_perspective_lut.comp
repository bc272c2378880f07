#version 460
#extension GL_GOOGLE_include_directive : require
// The aerial-perspective LUT of one frame (physics/aerial_perspective_lut.glsl). An invocation integrates along
// one ray and stores the sum at each texel's distance.

layout(local_size_x = 8, local_size_y = 8) in;

#include "common/effect_constants.glsl"

#include "alpenglow/atmosphere.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image3D aerialFirst;
layout(set = 1, binding = 1, ALPENGLOW_STORAGE) uniform writeonly image3D aerialSecond;
layout(set = 1, binding = 2, ALPENGLOW_STORAGE) uniform writeonly image3D aerialThird;

// Mirrored by AerialPerspectiveLutConstants in atmosphere/passes/aerial_perspective_lut.cpp.
layout(push_constant) uniform Camera {
  float altitude;
  float muS;
  float horizon, span, bend, extinction_, startHeight, height;  // AerialView
};

void storeTexel(ivec3 texel, InscatteringState state) {
  PathLight light = inscatteredLight(alpenglowMedium, state);
  vec4 first, second, third;
  encodeAerialPerspective(light.rayleigh, light.mie, light.multiple, light.depth, state.t, first, second, third);
  imageStore(aerialFirst, texel, first);
  imageStore(aerialSecond, texel, second);
  imageStore(aerialThird, texel, third);
}

void main() {
  ivec2 column = ivec2(gl_GlobalInvocationID.xy);  // the image is whole groups
  AerialView view = AerialView(SkyViewParams(horizon, span, bend), extinction_, startHeight, height);
  Ray ray = gridRay(alpenglowMedium, aerialGrid(view.skyView), view.skyView, altitude, muS, float(column.x),
                    float(column.y));
  AerialSegment segment = aerialSegment(alpenglowMedium, view, ray);
  vec3 cuts = pathCuts(alpenglowMedium, ray, segment.extent, true);
  SourceRay source = makeSourceRay(alpenglowShape, ray.nu);
  InscatteringState state = startInscattering(alpenglowMedium, ray);
  int texel = 0;
  // A panel for each texel, and one more for each cut.
  for (int i = 0; i < kAerialDistances + 3; ++i) {
    if (texel == kAerialDistances) break;
    float target = aerialTexelDistance(segment, texel);
    float next = min(cutAfter(cuts, state.t, target), target);
    float d = next - state.t;
    state = integratePanel(alpenglowMedium, alpenglowShape, ray, source, state,
                           vec2(state.t + firstOfPanel() * d, d), vec2(next - firstOfPanel() * d, d), next,
                           true, ALPENGLOW_MULTIPLE);
    if (next == target) {
      storeTexel(ivec3(column, texel), state);
      ++texel;
    }
  }
}
