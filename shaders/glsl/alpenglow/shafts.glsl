// What recordShafts found out about a frame: whether surfaces and points of the air see the sun. For a host's
// own fragment shaders bind shaftSet() at set ALPENGLOW_SHAFT_SET (1 unless defined before). Positions are in
// metres from the camera, in axes parallel to the planet's frame.
#ifndef ALPENGLOW_SHAFTS
#define ALPENGLOW_SHAFTS

#ifndef ALPENGLOW_SHAFT_SET
#define ALPENGLOW_SHAFT_SET 1
#endif

// ShaftMethod of alpenglow/shafts.h.
const int kShaftExact = 0;
const int kShaftPaper = 1;
const int kShaftMarch = 2;

// Mirrored by ShaftFrame in atmosphere/shafts/shaft_frame.h.
layout(set = ALPENGLOW_SHAFT_SET, binding = 0, std140) uniform AlpenglowShaftFrame {
  mat4 clipFromCamera;
  vec4 upAltitude;     // the camera's vertical; altitude
  vec4 forwardNear;    // where it looks; distance of the near plane along it
  vec4 rightOffsetX;   // scaled so that ndc.x right + ndc.y down + forward is a ray (orthographic: right and
  vec4 downOffsetY;    // down are metres); w: pixel of the viewport's corner
  vec4 sunRange;       // towards the sun; metres between the planes of the map where depth is 0 and 1
  vec4 mapU;           // dot(xyz, position) + w: texels of the map from the sun,
  vec4 mapV;
  vec4 mapDepth;       // and depth in it
  vec4 map;            // texels on a side; longest beam in the air, metres; the camera's radius
  vec4 cornerStep;     // the map's corner at depth 0, metres from the camera; w: texel along the rows
  vec4 rowStep;        // from texel to texel in a row: a unit vector; w: from row to row
  vec4 columnStep;     // from row to row: a unit vector
  vec4 pixels;         // ndc of a pixel: 2 / size, xy; method; 1: orthographic
  vec4 airSlice;       // AirView of the camera: SliceView, extinction_
  vec4 airSun;         // horizontal unit vector towards the sun; startHeight
  vec4 airHeight;      // height; unused
} alpenglowShaft;

// Depth, seen from the sun; the frame's results.
layout(set = ALPENGLOW_SHAFT_SET, binding = 1) uniform sampler2D alpenglowSunMap;
layout(set = ALPENGLOW_SHAFT_SET, binding = 2) uniform sampler2D alpenglowShaftSums;
layout(set = ALPENGLOW_SHAFT_SET, binding = 3) uniform sampler2D alpenglowShaftBounds;

// Position in the map: texels, and depth.
vec3 alpenglowOnSunMap(vec3 position) {
  return vec3(dot(alpenglowShaft.mapU.xyz, position) + alpenglowShaft.mapU.w,
              dot(alpenglowShaft.mapV.xyz, position) + alpenglowShaft.mapV.w,
              dot(alpenglowShaft.mapDepth.xyz, position) + alpenglowShaft.mapDepth.w);
}

// Depth of what the sun meets first in a texel; beyond everything where it meets nothing.
float alpenglowFirstDepth(vec2 texel) {
  float size = alpenglowShaft.map.x;
  bool inside = min(texel.x, texel.y) >= 0.0 && max(texel.x, texel.y) < size;
  float depth = texelFetch(alpenglowSunMap, ivec2(clamp(texel, vec2(0.0), vec2(size - 1.0))), 0).r;
  return inside && depth < 1.0 ? depth : 1e30;
}

// Metres along the sun's beam from a point to the ground, or at most as far as a beam is in the air. The
// point's altitude comes from the camera's, without cancelling (physics/geometry.glsl).
float alpenglowBeamLength(vec3 p) {
  vec3 up = alpenglowShaft.upAltitude.xyz, beam = -alpenglowShaft.sunRange.xyz;
  float r0 = alpenglowShaft.map.z;
  float ground = r0 - alpenglowShaft.upAltitude.w;
  float gain = dot(p, p) + 2.0 * r0 * dot(up, p);
  float r = sqrt(max(r0 * r0 + gain, 0.0));
  float h = max(alpenglowShaft.upAltitude.w + gain / (r + r0), 0.0);
  float rMu = dot(up * r0 + p, beam);
  float rho2 = h * (2.0 * ground + h);
  float delta = rMu * rMu - rho2;
  bool hits = rMu < 0.0 && delta > 0.0;
  return hits ? rho2 / max(sqrt(max(delta, 0.0)) - rMu, 1e-6) : alpenglowShaft.map.y;
}

// A vertex of the surface between light and shadow: what the sun meets at a texel's middle, or where its beam
// ends if it meets nothing.
vec3 alpenglowShadowVertex(ivec2 texel) {
  float depth = texelFetch(alpenglowSunMap, texel, 0).r;
  vec2 middle = vec2(texel) + 0.5;
  vec3 start = alpenglowShaft.cornerStep.xyz +
               middle.x * alpenglowShaft.cornerStep.w * alpenglowShaft.rowStep.xyz +
               middle.y * alpenglowShaft.rowStep.w * alpenglowShaft.columnStep.xyz;
  float along = depth < 1.0 ? depth * alpenglowShaft.sunRange.w : alpenglowBeamLength(start);
  return start - along * alpenglowShaft.sunRange.xyz;
}

// Whether a point lies behind that surface, of which each cell is two triangles, as surface.vert draws it.
bool alpenglowBehindSurface(vec3 position) {
  vec3 at = alpenglowOnSunMap(position);
  vec2 cell = floor(at.xy - 0.5), f = at.xy - 0.5 - cell;
  float last = alpenglowShaft.map.x - 2.0;
  bool inside = min(cell.x, cell.y) >= 0.0 && max(cell.x, cell.y) <= last;
  ivec2 c = ivec2(clamp(cell, vec2(0.0), vec2(last)));
  // The strip's diagonal runs from (0, 1) to (1, 0).
  bool second = f.x + f.y > 1.0;
  vec3 across = alpenglowShadowVertex(c + ivec2(1, 0)), down = alpenglowShadowVertex(c + ivec2(0, 1));
  vec3 corner = alpenglowShadowVertex(second ? c + ivec2(1, 1) : c);
  vec2 weight = second ? 1.0 - f.yx : f;
  vec3 surface = corner + weight.x * (across - corner) + weight.y * (down - corner);
  return inside && dot(surface - position, alpenglowShaft.sunRange.xyz) > 0.0;
}

// Whether a point lies in shadow: behind all four texels about it, so that a lit surface, or a point just
// above it, never does for the slope within a texel.
bool alpenglowInShadow(vec3 position) {
  vec3 at = alpenglowOnSunMap(position);
  vec2 corner = at.xy - 0.5;
  float first = max(max(alpenglowFirstDepth(corner), alpenglowFirstDepth(corner + vec2(1.0, 0.0))),
                    max(alpenglowFirstDepth(corner + vec2(0.0, 1.0)),
                        alpenglowFirstDepth(corner + vec2(1.0, 1.0))));
  return at.z > first;
}

// Where the ray of a pixel begins: at the camera, or on the plane through it.
vec3 alpenglowRayOrigin(vec2 fragCoord) {
  vec2 ndc = (fragCoord - vec2(alpenglowShaft.rightOffsetX.w, alpenglowShaft.downOffsetY.w)) *
                 alpenglowShaft.pixels.xy - 1.0;
  vec3 across = ndc.x * alpenglowShaft.rightOffsetX.xyz + ndc.y * alpenglowShaft.downOffsetY.xyz;
  return alpenglowShaft.pixels.w > 0.5 ? across : vec3(0.0);
}

// Whether the surface seen in a pixel, `position`, sees the sun, before its own slope is asked.
float alpenglowSunlit(vec4 fragCoord, vec3 position) {
  float dn = texelFetch(alpenglowShaftSums, ivec2(fragCoord.xy), 0).x;
  bool paper = int(alpenglowShaft.pixels.z) == kShaftPaper;
  bool shadow = paper ? dn < -0.5 : alpenglowInShadow(position);
  return shadow ? 0.0 : 1.0;
}

#endif  // ALPENGLOW_SHAFTS
