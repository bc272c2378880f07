// What the shaders of the moment solver share: bindings and reads. Some bindings have two names: no shader
// reads both. All but the sources are 32-bit floats: radiance spans 30 powers of ten.
#include "common/effect_constants.glsl"
#include "tile.glsl"

#include "physics/physics.glsl"

layout(set = 0, binding = 0, std140) uniform Atmosphere {
  Medium medium;
  MomentShape boundShape;
};

// What is bound, but the counts, which end loops, are no mere uniforms: alpenglow/moment_tables.glsl says why.
MomentShape openShape() {
  MomentShape s = boundShape;
  float zero = float(int(gl_GlobalInvocationID.x) >> 30);
  s.zenithsSky += zero;
  s.zenithsLimb += zero;
  s.zenithsGround += zero;
  s.azimuths += zero;
  s.degree += zero;
  s.solverPanels += zero;
  s.layers += zero;
  return s;
}
MomentShape shape = openShape();

layout(set = 0, binding = 1) uniform sampler2D depthTable;
layout(set = 0, binding = 2) uniform sampler2D fieldTable;  // of the order before
#ifndef ALPENGLOW_WITHOUT_SOURCE
layout(set = 0, binding = 3) uniform sampler3D sourceTable;
#endif
layout(set = 0, binding = 4) uniform sampler2D radianceTable;
layout(set = 0, binding = 5) uniform sampler2D radianceMieTable;
layout(set = 0, binding = 6) uniform sampler2D radianceGroundTable;
layout(set = 0, binding = 4) uniform sampler2D modesTable;
layout(set = 0, binding = 5) uniform sampler2D momentsTable;
layout(set = 0, binding = 6) uniform sampler2D sourceModesTable;
layout(set = 0, binding = 7) uniform sampler2D ruleTable;
layout(set = 0, binding = 8) uniform sampler2D legendreTable;
layout(set = 0, binding = 8) uniform sampler2D rotationTable;

Spectrum readDepth(vec2 uv) { return textureLod(depthTable, uv, 0.0).rgb; }
Spectrum readMoments(vec2 uv) { return textureLod(fieldTable, uv, 0.0).rgb; }
#ifndef ALPENGLOW_WITHOUT_SOURCE
Spectrum readSource(vec3 uvw) { return textureLod(sourceTable, uvw, 0.0).rgb; }
#endif
Spectrum fetchRadiance(int x, int y) { return texelFetch(radianceTable, ivec2(x, y), 0).rgb; }
Spectrum fetchRadianceMie(int x, int y) { return texelFetch(radianceMieTable, ivec2(x, y), 0).rgb; }
Spectrum fetchRadianceGround(int x, int y) {
  return texelFetch(radianceGroundTable, ivec2(x, y), 0).rgb;
}
Spectrum fetchModes(int x, int y) { return texelFetch(modesTable, ivec2(x, y), 0).rgb; }
Spectrum fetchMoments(int x, int y) { return texelFetch(momentsTable, ivec2(x, y), 0).rgb; }
Spectrum fetchSourceModes(int x, int y) { return texelFetch(sourceModesTable, ivec2(x, y), 0).rgb; }
vec2 fetchRule(int x, int y) { return texelFetch(ruleTable, ivec2(x, y), 0).rg; }
float fetchRotation(int x, int y) { return texelFetch(rotationTable, ivec2(x, y), 0).r; }
Spectrum fetchNode(int x, int y) { return texelFetch(fieldTable, ivec2(x, y), 0).rgb; }
float fetchLegendre(int x, int y) { return texelFetch(legendreTable, ivec2(x, y), 0).r; }

#include "physics/field_lookup.glsl"

#include "physics/inscattering.glsl"

#include "physics/harmonics.glsl"

#include "physics/moments.glsl"

#include "physics/node_interpolation.glsl"

// The node of a texel whose x is the sun's angle and whose row is the altitude.
int nodeOf(int iMuS, int iR) { return iMuS + int(shape.nodesMuS) * iR; }

// A layer of the table of moments, plain: before encodeLayer.
Spectrum plainLayer(NodeField node, int layer) {
  if (layer == 0) return node.mean;
  if (layer == 1) return node.xx;
  if (layer == 2) return node.zz;
  if (layer == 3) return node.xz;
  return node.irradiance;
}

Spectrum fetchLayer(sampler2D table, ivec2 node, int layer) {
  return texelFetch(table, node + ivec2(0, layer * int(shape.nodesR)), 0).rgb;
}
