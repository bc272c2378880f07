// Shadows of a frame's casters on surfaces and on points of the atmosphere. A host's own fragment shaders bind
// FrameWork::sets[kViewSetLightShafts] at set ALPENGLOW_LIGHT_SHAFT_SET (1 unless defined before). Positions are
// in metres from the camera, in axes parallel to the planet's frame.
#ifndef ALPENGLOW_LIGHT_SHAFTS
#define ALPENGLOW_LIGHT_SHAFTS

#ifndef ALPENGLOW_LIGHT_SHAFT_SET
#define ALPENGLOW_LIGHT_SHAFT_SET 1
#endif

// LightShaftMethod of alpenglow/view.h, minus 1: methodIndex of atmosphere/passes/light_shaft_frame.h.
const int kLightVolume = 0;
const int kShadowVolume = 1;
const int kRayMarch = 2;

// Mirrored by LightShaftFrame in atmosphere/passes/light_shaft_frame.h.
layout(set = ALPENGLOW_LIGHT_SHAFT_SET, binding = 0, std140) uniform AlpenglowLightShaftFrame {
  mat4 clipFromCamera;
  vec4 upAltitude;     // the camera's vertical; altitude
  vec4 forwardNear;    // where it looks; distance of the near plane along it
  vec4 rightOffsetX;   // scaled so that ndc.x right + ndc.y down + forward is a ray (orthographic: right and
  vec4 downOffsetY;    // down are metres); w: pixel of the viewport's corner
  vec4 sunRange;       // towards the sun; metres between the planes of the map where depth is 0 and 1
  vec4 mapU;           // dot(xyz, position) + w: texels of the shadow map,
  vec4 mapV;
  vec4 mapDepth;       // and depth in it
  vec4 map;            // texels on a side; longest beam in the atmosphere, metres; the camera's radius; texels from
                       // vertex to vertex of the light-volume mesh
  vec4 cornerStep;     // the map's corner at depth 0, metres from the camera; w: texel along the rows
  vec4 rowStep;        // from texel to texel in a row: a unit vector; w: from row to row
  vec4 columnStep;     // from row to row: a unit vector
  vec4 pixels;         // ndc of a pixel: 2 / size, xy; method, or -1: no sunlight reaches a caster, and the maps hold
                       // nothing; 1: orthographic
  vec4 aerialSkyView;  // AerialView of the camera: SkyViewParams, extinction_
  vec4 aerialSun;      // horizontal unit vector towards the sun; startHeight
  vec4 aerialHeight;   // height; metres that the light-volume mesh lies behind what the sun meets
} alpenglowLightShaft;

// Depth from the sun; the sums and bounds of this frame.
layout(set = ALPENGLOW_LIGHT_SHAFT_SET, binding = 1) uniform sampler2D alpenglowShadowMap;
layout(set = ALPENGLOW_LIGHT_SHAFT_SET, binding = 2) uniform sampler2D alpenglowLightShaftSums;
layout(set = ALPENGLOW_LIGHT_SHAFT_SET, binding = 3) uniform sampler2D alpenglowLightShaftBounds;

// A VkDrawIndirectCommand, then the blocks of the light-volume mesh that are visible in this frame.
const int kLightShaftBlock = 16;  // cells on a side; also in atmosphere/passes/light_shaft_frame.h
#ifndef ALPENGLOW_LIGHT_SHAFT_BLOCKS_ACCESS
#define ALPENGLOW_LIGHT_SHAFT_BLOCKS_ACCESS readonly
#endif
layout(set = ALPENGLOW_LIGHT_SHAFT_SET, binding = 4, std430) ALPENGLOW_LIGHT_SHAFT_BLOCKS_ACCESS buffer
AlpenglowLightShaftBlocks {
  uint vertexCount;
  uint instanceCount;
  uint firstVertex;
  uint firstInstance;
  float start;  // 1 if the camera is in shadow
  uint blocks[];
} alpenglowLightShaftBlocks;

// Position in the map: texels, and depth.
vec3 alpenglowOnShadowMap(vec3 position) {
  return vec3(dot(alpenglowLightShaft.mapU.xyz, position) + alpenglowLightShaft.mapU.w,
              dot(alpenglowLightShaft.mapV.xyz, position) + alpenglowLightShaft.mapV.w,
              dot(alpenglowLightShaft.mapDepth.xyz, position) + alpenglowLightShaft.mapDepth.w);
}

// Depth of the first caster in a texel; 1e30 where there is none.
float alpenglowFirstDepth(vec2 texel) {
  float size = alpenglowLightShaft.map.x;
  bool inside = min(texel.x, texel.y) >= 0.0 && max(texel.x, texel.y) < size;
  float depth = texelFetch(alpenglowShadowMap, ivec2(clamp(texel, vec2(0.0), vec2(size - 1.0))), 0).r;
  return inside && depth < 1.0 ? depth : 1e30;
}

// Metres along the sun's beam from a point to the ground, or the longest beam in the atmosphere. The point's
// altitude is computed from the camera's without cancellation (physics/geometry.glsl).
float alpenglowBeamLength(vec3 p) {
  vec3 up = alpenglowLightShaft.upAltitude.xyz, beam = -alpenglowLightShaft.sunRange.xyz;
  float r0 = alpenglowLightShaft.map.z;
  float ground = r0 - alpenglowLightShaft.upAltitude.w;
  float gain = dot(p, p) + 2.0 * r0 * dot(up, p);
  float r = sqrt(max(r0 * r0 + gain, 0.0));
  float h = max(alpenglowLightShaft.upAltitude.w + gain / (r + r0), 0.0);
  float rMu = dot(up * r0 + p, beam);
  float rho2 = h * (2.0 * ground + h);
  float delta = rMu * rMu - rho2;
  bool hits = rMu < 0.0 && delta > 0.0;
  return hits ? rho2 / max(sqrt(max(delta, 0.0)) - rMu, 1e-6) : alpenglowLightShaft.map.y;
}

// The point of the beam through `at` (texels of the map), `along` metres from where depth is 0.
vec3 alpenglowOnBeam(vec2 at, float along) {
  return alpenglowLightShaft.cornerStep.xyz +
         at.x * alpenglowLightShaft.cornerStep.w * alpenglowLightShaft.rowStep.xyz +
         at.y * alpenglowLightShaft.rowStep.w * alpenglowLightShaft.columnStep.xyz -
         along * alpenglowLightShaft.sunRange.xyz;
}

// The texel of a vertex of the light-volume mesh: one every map.w texels, and the last.
ivec2 alpenglowMeshTexel(ivec2 vertex) {
  return min(vertex * int(alpenglowLightShaft.map.w), ivec2(int(alpenglowLightShaft.map.x) - 1));
}

// Cells of the mesh along a side.
int alpenglowMeshCells() {
  int step_ = int(alpenglowLightShaft.map.w);
  return (int(alpenglowLightShaft.map.x) - 2 + step_) / step_;
}

// The position of a vertex: a little behind the caster at the texel's centre, so that lit surfaces hide the mesh,
// or the end of the beam where there is no caster.
vec3 alpenglowMeshVertex(ivec2 vertex) {
  ivec2 texel = alpenglowMeshTexel(vertex);
  float depth = texelFetch(alpenglowShadowMap, texel, 0).r;
  vec2 middle = vec2(texel) + 0.5;
  float along = depth < 1.0 ? depth * alpenglowLightShaft.sunRange.w
                            : alpenglowBeamLength(alpenglowOnBeam(middle, 0.0));
  return alpenglowOnBeam(middle, along + alpenglowLightShaft.aerialHeight.y);
}

// Whether a point lies behind the mesh, seen from the sun. A cell is two triangles, as light_volume_mesh.vert
// draws them.
bool alpenglowBehindLightVolumeMesh(vec3 position) {
  vec2 at = alpenglowOnShadowMap(position).xy - 0.5;
  vec2 cell = floor(at / alpenglowLightShaft.map.w);
  float last = float(alpenglowMeshCells() - 1);
  bool inside = min(at.x, at.y) >= 0.0 && max(at.x, at.y) <= alpenglowLightShaft.map.x - 1.0;
  ivec2 c = ivec2(clamp(cell, vec2(0.0), vec2(last)));
  vec2 low = vec2(alpenglowMeshTexel(c)), high = vec2(alpenglowMeshTexel(c + 1));
  vec2 f = (at - low) / max(high - low, vec2(1.0));
  // The strip's diagonal runs from (0, 1) to (1, 0).
  bool second = f.x + f.y > 1.0;
  vec3 across = alpenglowMeshVertex(c + ivec2(1, 0)), down = alpenglowMeshVertex(c + ivec2(0, 1));
  vec3 corner = alpenglowMeshVertex(second ? c + ivec2(1, 1) : c);
  vec2 weight = second ? 1.0 - f.yx : f;
  vec3 surface = corner + weight.x * (across - corner) + weight.y * (down - corner);
  return inside && dot(surface - position, alpenglowLightShaft.sunRange.xyz) > 0.0;
}

// Whether a point lies in shadow: behind all four texels about it, so that a lit surface, or a point just
// above it, never does for the slope within a texel.
bool alpenglowInShadow(vec3 position) {
  vec3 at = alpenglowOnShadowMap(position);
  vec2 corner = at.xy - 0.5;
  float first = max(max(alpenglowFirstDepth(corner), alpenglowFirstDepth(corner + vec2(1.0, 0.0))),
                    max(alpenglowFirstDepth(corner + vec2(0.0, 1.0)),
                        alpenglowFirstDepth(corner + vec2(1.0, 1.0))));
  return at.z > first;
}

// Offset of a pixel from the middle of the picture: forward + offset is its ray, or (orthographic) the offset is
// its ray's origin.
vec3 alpenglowPixelOffset(vec2 fragCoord) {
  vec2 ndc = (fragCoord - vec2(alpenglowLightShaft.rightOffsetX.w, alpenglowLightShaft.downOffsetY.w)) *
                 alpenglowLightShaft.pixels.xy - 1.0;
  return ndc.x * alpenglowLightShaft.rightOffsetX.xyz + ndc.y * alpenglowLightShaft.downOffsetY.xyz;
}

// Where the ray of a pixel begins: at the camera, or on the plane through it.
vec3 alpenglowRayOrigin(vec2 fragCoord) {
  return alpenglowLightShaft.pixels.w > 0.5 ? alpenglowPixelOffset(fragCoord) : vec3(0.0);
}

// The sunlit share of a point by the shadow map, filtered over 3 x 3 texels: about as soft an edge as the sun's
// disc gives a shadow some kilometres away.
float alpenglowSunShare(vec3 position) {
  vec3 at = alpenglowOnShadowMap(position);
  vec2 corner = floor(at.xy - 0.5);
  vec2 f = at.xy - 0.5 - corner;
  float share = 0.0;
  for (int y = -1; y <= 2; ++y) {
    for (int x = -1; x <= 2; ++x) {
      vec2 weight = vec2(x < 0 ? 1.0 - f.x : x > 1 ? f.x : 1.0, y < 0 ? 1.0 - f.y : y > 1 ? f.y : 1.0);
      bool lit = alpenglowFirstDepth(corner + vec2(x, y)) >= at.z;
      share += lit ? weight.x * weight.y / 9.0 : 0.0;
    }
  }
  return share;
}

// The sunlit share of the surface in a pixel, at `position`, without the cosine of its slope. The point is lifted
// off the surface by texels of the map, or it would lie in its own shadow.
float alpenglowSunlit(vec4 fragCoord, vec3 position, vec3 normal) {
  if (alpenglowLightShaft.pixels.z < 0.0) return 1.0;
  if (int(alpenglowLightShaft.pixels.z) == kShadowVolume)
    return texelFetch(alpenglowLightShaftSums, ivec2(fragCoord.xy), 0).x < -0.5 ? 0.0 : 1.0;
  float texel = max(alpenglowLightShaft.cornerStep.w, alpenglowLightShaft.rowStep.w);
  return alpenglowSunShare(position + texel * (normal + 2.0 * alpenglowLightShaft.sunRange.xyz));
}

#endif  // ALPENGLOW_LIGHT_SHAFTS
