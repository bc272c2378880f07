#version 460
#extension GL_GOOGLE_include_directive : require
// The air volume of one frame (physics/air_volume.glsl). An invocation walks along one ray and stores what it
// has gathered at each texel's distance.

layout(local_size_x = 8, local_size_y = 8) in;

#include "common/effect_constants.glsl"

#include "alpenglow/atmosphere.glsl"

layout(set = 1, binding = 0, ALPENGLOW_STORAGE) uniform writeonly image3D airFirst;
layout(set = 1, binding = 1, ALPENGLOW_STORAGE) uniform writeonly image3D airSecond;
layout(set = 1, binding = 2, ALPENGLOW_STORAGE) uniform writeonly image3D airThird;

// Mirrored by VolumeConstants in atmosphere/sky/air_volume.cpp.
layout(push_constant) uniform Camera {
  float altitude;
  float muS;
  float horizon, span, bend, extinction_, startHeight, height;  // AirView
};

void storeTexel(ivec3 texel, PathWalk walk) {
  PathLight light = walkedLight(alpenglowMedium, walk);
  vec4 first, second, third;
  encodeAir(light.rayleigh, light.mie, light.multiple, light.depth, walk.t, first, second, third);
  imageStore(airFirst, texel, first);
  imageStore(airSecond, texel, second);
  imageStore(airThird, texel, third);
}

void main() {
  ivec2 column = ivec2(gl_GlobalInvocationID.xy);  // the image is whole groups
  AirView view = AirView(SliceView(horizon, span, bend), extinction_, startHeight, height);
  Ray ray = gridRay(alpenglowMedium, airGrid(view.slice), view.slice, altitude, muS, float(column.x),
                    float(column.y));
  AirStretch stretch = airStretch(alpenglowMedium, view, ray);
  vec3 cuts = pathCuts(alpenglowMedium, ray, stretch.extent, true);
  SourceRay source = makeSourceRay(alpenglowShape, ray.nu);
  PathWalk walk = startWalk(alpenglowMedium, ray);
  int texel = 0;
  // A panel to each texel, and one more for each cut.
  for (int i = 0; i < kAirDistances + 3; ++i) {
    if (texel == kAirDistances) break;
    float target = airTexelDistance(stretch, texel);
    float next = min(cutAfter(cuts, walk.t, target), target);
    float d = next - walk.t;
    walk = walkPanel(alpenglowMedium, alpenglowShape, ray, source, walk,
                     vec2(walk.t + firstOfPanel() * d, d), vec2(next - firstOfPanel() * d, d), next,
                     true, ALPENGLOW_MULTIPLE);
    if (next == target) {
      storeTexel(ivec3(column, texel), walk);
      ++texel;
    }
  }
}
