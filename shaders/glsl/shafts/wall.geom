#version 460
#extension GL_GOOGLE_include_directive : require
// Walls of shadow below the silhouette edges seen from the sun. An edge that lies in shadow itself has none,
// and a wall ends where what the sun meets beside it says so: what is left divides light from shadow, but for
// ends, which wall.frag cuts. One invocation an edge.

layout(triangles_adjacency, invocations = 3) in;
layout(triangle_strip, max_vertices = 32) out;

#include "alpenglow/shafts.glsl"
#include "shafts/facing.glsl"

layout(set = ALPENGLOW_SHAFT_SET, binding = 4) uniform sampler2D sunBlocks;

layout(location = 0) in vec3 corner[];
layout(location = 0) out vec3 position;
layout(location = 1) out flat vec2 outward;  // a texel's step on the map, to the lit side

const int kPieces = 15;  // of a wall; each twice as long as all before it, so that neighbours meet at corners

// The greatest depth that the sun reaches beside an edge on the map.
float reach(vec2 from, vec2 to) {
  float block = alpenglowShaft.wall.z;
  int steps = int(min(length(to - from) / block, 64.0)) + 1;
  float size = alpenglowShaft.wall.y;
  float greatest = 0.0;
  for (int i = 0; i <= steps; ++i) {
    vec2 at = mix(from, to, float(i) / float(steps));
    bool inside = min(at.x, at.y) >= 0.0 && max(at.x, at.y) < size;
    float depth = texelFetch(sunBlocks, ivec2(clamp(at, vec2(0.0), vec2(size - 1.0)) / block), 0).r;
    greatest = max(greatest, inside ? depth : 1.0);
  }
  return steps > 64 ? 1.0 : greatest;
}

// Metres along the sun's beam from a point to the ground, with some to spare, or at most as far as a beam is in
// the air. The point's altitude comes from the camera's, without cancelling (physics/geometry.glsl).
float beamLength(vec3 p) {
  vec3 up = alpenglowShaft.upAltitude.xyz, beam = -alpenglowShaft.sunRange.xyz;
  float r0 = alpenglowShaft.wall.w;
  float ground = r0 - alpenglowShaft.upAltitude.w;
  float gain = dot(p, p) + 2.0 * r0 * dot(up, p);
  float r = sqrt(max(r0 * r0 + gain, 0.0));
  float h = max(alpenglowShaft.upAltitude.w + gain / (r + r0), 0.0);
  float rMu = dot(up * r0 + p, beam);
  float rho2 = h * (2.0 * ground + h);
  float delta = rMu * rMu - rho2;
  bool hits = rMu < 0.0 && delta > 0.0;
  return hits ? 1.02 * rho2 / max(sqrt(max(delta, 0.0)) - rMu, 1e-6) + 100.0 : alpenglowShaft.wall.x;
}

void emitAt(vec3 p, vec2 side) {
  position = p;
  outward = side;
  gl_Position = alpenglowShaft.clipFromCamera * vec4(p, 1.0);
  EmitVertex();
}

void main() {
  int i = 2 * gl_InvocationID;
  vec3 p = corner[i], q = corner[(i + 2) % 6], opposite = corner[(i + 4) % 6];
  vec3 neighbour = corner[i + 1];
  float f = facing(p, q, opposite);
  // Closed casters: from triangles that see the sun. A border's neighbour is the triangle itself from behind.
  bool silhouette = f > 0.0 ? !(facing(q, p, neighbour) > 0.0) : f < 0.0 && neighbour == opposite;
  if (!silhouette) return;

  vec3 mapP = alpenglowOnSunMap(p), mapQ = alpenglowOnSunMap(q);
  vec2 along = mapQ.xy - mapP.xy;
  vec2 side = vec2(along.y, -along.x);
  vec2 inward = alpenglowOnSunMap(opposite).xy - mapP.xy;
  side *= (dot(side, inward) > 0.0 ? -1.0 : 1.0) / max(length(side), 1e-20);
  vec2 shift = 1.5 * side;
  float highest = min(mapP.z, mapQ.z);
  float deepest = reach(mapP.xy + shift, mapQ.xy + shift);
  if (!(deepest > highest)) return;
  float needed = min(max(beamLength(p), beamLength(q)), alpenglowShaft.wall.x);
  if (deepest < 1.0) needed = min(needed, (deepest - highest) * alpenglowShaft.sunRange.w);

  vec3 sun = alpenglowShaft.sunRange.xyz;
  // Seen from the lit side its corners run counter-clockwise.
  if (f > 0.0) {
    vec3 first = p;
    p = q;
    q = first;
  }
  emitAt(p, side);
  emitAt(q, side);
  float length_ = alpenglowShaft.wall.x / exp2(float(kPieces - 1));
  for (int k = 0; k < kPieces; ++k) {
    emitAt(p - length_ * sun, side);
    emitAt(q - length_ * sun, side);
    if (length_ >= needed) break;
    length_ *= 2.0;
  }
  EndPrimitive();
}
