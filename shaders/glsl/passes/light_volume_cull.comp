#version 460
#extension GL_GOOGLE_include_directive : require
// Finds the blocks of the light-volume mesh that may be visible, for an indirect draw with an instance for each.
// Also finds whether the camera itself is in shadow.

layout(local_size_x = 64) in;

#define ALPENGLOW_LIGHT_SHAFT_SET 0
#define ALPENGLOW_LIGHT_SHAFT_BLOCKS_ACCESS
#include "alpenglow/light_shafts.glsl"

// The least and the greatest depth of the vertices of a block; false if it has no caster.
bool blockReach(ivec2 first, out float least, out float greatest) {
  least = 1e30;
  greatest = 0.0;
  float empty = 0.0;
  for (int y = 0; y <= kLightShaftBlock; ++y) {
    for (int x = 0; x <= kLightShaftBlock; ++x) {
      float depth = texelFetch(alpenglowShadowMap, alpenglowMeshTexel(first + ivec2(x, y)), 0).r;
      bool met = depth < 1.0;
      least = met ? min(least, depth) : least;
      greatest = met ? max(greatest, depth) : greatest;
      empty = met ? empty : 1.0;
    }
  }
  if (empty > 0.0) greatest = max(greatest, alpenglowLightShaft.map.y / alpenglowLightShaft.sunRange.w);
  return least < 1.0;
}

// Whether all corners of the box around a block lie on the outer side of one of the picture's edges.
bool outsidePicture(ivec2 first, float least, float greatest) {
  vec4 low = vec4(1.0), high = vec4(1.0);  // products over the corners: 1 if all are outside
  float behind = 1.0;
  for (int i = 0; i < 8; ++i) {
    vec2 at = vec2(alpenglowMeshTexel(first + kLightShaftBlock * ivec2(i & 1, i >> 1 & 1))) + 0.5;
    float depth = (i & 4) == 0 ? least : greatest;
    vec3 p = alpenglowOnBeam(at, depth * alpenglowLightShaft.sunRange.w + alpenglowLightShaft.aerialHeight.y);
    vec4 clip = alpenglowLightShaft.clipFromCamera * vec4(p, 1.0);
    low.xy *= vec2(lessThan(clip.xy, -clip.ww));
    high.xy *= vec2(greaterThan(clip.xy, clip.ww));
    behind *= clip.w < 0.0 ? 1.0 : 0.0;
  }
  return max(max(low.x, low.y), max(max(high.x, high.y), behind)) > 0.5;
}

void main() {
  int side = (alpenglowMeshCells() - 1) / kLightShaftBlock + 1;
  int index = int(gl_GlobalInvocationID.x);
  ivec2 first = ivec2(index % side, index / side) * kLightShaftBlock;
  float least, greatest;
  bool any_ = blockReach(first, least, greatest);
  if (index < side * side && any_ && !outsidePicture(first, least, greatest)) {
    uint slot = atomicAdd(alpenglowLightShaftBlocks.instanceCount, 1u);
    alpenglowLightShaftBlocks.blocks[slot] = uint(index);
  }
  if (index == 0) alpenglowLightShaftBlocks.start = alpenglowBehindLightVolumeMesh(vec3(0.0)) ? 1.0 : 0.0;
}
