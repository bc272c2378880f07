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
  vec4 wall;           // longest wall, metres; texels on a side of the map and of a block; the camera's radius
  vec4 pixels;         // ndc of a pixel: 2 / size, xy; method; 1: orthographic
  vec4 airSlice;       // AirView of the camera: SliceView, extinction_
  vec4 airSun;         // horizontal unit vector towards the sun; startHeight
  vec4 airHeight;      // height; unused
} alpenglowShaft;

// Depth in it, seen from the sun; as blocks, the greatest in and around each; the frame's results.
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
  float size = alpenglowShaft.wall.y;
  bool inside = min(texel.x, texel.y) >= 0.0 && max(texel.x, texel.y) < size;
  float depth = texelFetch(alpenglowSunMap, ivec2(clamp(texel, vec2(0.0), vec2(size - 1.0))), 0).r;
  return inside && depth < 1.0 ? depth : 1e30;
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
  vec4 sums = texelFetch(alpenglowShaftSums, ivec2(fragCoord.xy), 0);
  int method = int(alpenglowShaft.pixels.z);
  float start = alpenglowInShadow(alpenglowRayOrigin(fragCoord.xy)) ? 1.0 : 0.0;
  bool exact = start + sums.a > 0.5;
  bool paper = sums.x < -0.5;
  bool march = alpenglowInShadow(position);
  return (method == kShaftExact ? exact : method == kShaftPaper ? paper : march) ? 0.0 : 1.0;
}

#endif  // ALPENGLOW_SHAFTS
