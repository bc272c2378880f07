#version 460
#extension GL_GOOGLE_include_directive : require
// Shadow volumes of Bruneton & Neyret 2008, section 5: each triangle that faces away from the sun begins one,
// which runs along the beam out of the atmosphere. Triangles share their walls: a wall is drawn where exactly one
// of the two triangles at an edge faces away. ZP+: what lies between the near plane and the sun is projected onto
// that plane, so that the count is right for a camera in shadow.

layout(triangles_adjacency) in;
layout(triangle_strip, max_vertices = 23) out;

#include "alpenglow/light_shafts.glsl"
#include "passes/facing.glsl"

layout(constant_id = 7) const bool kReversed = false;

layout(location = 0) in vec3 corner[];
layout(location = 0) out vec3 position;
layout(location = 1) out flat float onNearPlane;

out gl_PerVertex {
  vec4 gl_Position;
  float gl_ClipDistance[1];
};

float beforeNear(vec3 p) { return dot(alpenglowLightShaft.forwardNear.xyz, p) - alpenglowLightShaft.forwardNear.w; }

void emitAt(vec3 p) {
  position = p;
  onNearPlane = 0.0;
  gl_Position = alpenglowLightShaft.clipFromCamera * vec4(p, 1.0);
  gl_ClipDistance[0] = beforeNear(p);
  EmitVertex();
}

void emitOnNearPlane(vec3 p) {
  position = p;
  onNearPlane = 1.0;
  gl_Position = alpenglowLightShaft.clipFromCamera * vec4(p, 1.0);
  // Exactly: the near plane may be closer than the rounding error of a corner that is kilometres away.
  gl_Position.w = alpenglowLightShaft.pixels.w > 0.5 ? 1.0 : alpenglowLightShaft.forwardNear.w;
  gl_Position.z = kReversed ? gl_Position.w : 0.0;
  gl_ClipDistance[0] = 0.0;
  EmitVertex();
}

// Clips a polygon to where a w + b >= 0, w given with each corner.
void clipPolygon(inout vec4 polygon[5], inout int count, float a, float b) {
  vec4 kept[5];
  int n = 0;
  for (int i = 0; i < count; ++i) {
    vec4 p = polygon[i], q = polygon[i + 1 == count ? 0 : i + 1];
    float fp = a * p.w + b, fq = a * q.w + b;
    if (fp >= 0.0 && n < 5) kept[n++] = p;
    if ((fp >= 0.0) != (fq >= 0.0) && n < 5) kept[n++] = mix(p, q, fp / (fp - fq));
  }
  for (int i = 0; i < n; ++i) polygon[i] = kept[i];
  count = n;
}

// The section of the volume with the near plane: the triangle projected along the beam.
void emitSection(vec3 a, vec3 b, vec3 c, float length_) {
  vec3 sun = alpenglowLightShaft.sunRange.xyz, forward = alpenglowLightShaft.forwardNear.xyz;
  float slope = dot(forward, sun);
  // A beam parallel to the plane is tilted slightly.
  if (abs(slope) < 1e-5) {
    sun += (slope < 0.0 ? -1e-5 : 1e-5) * forward;
    slope = slope < 0.0 ? -1e-5 : 1e-5;
  }
  // w: metres along the beam to the plane.
  vec4 polygon[5];
  polygon[0] = vec4(a, beforeNear(a) / slope);
  polygon[1] = vec4(b, beforeNear(b) / slope);
  polygon[2] = vec4(c, beforeNear(c) / slope);
  int count = 3;
  clipPolygon(polygon, count, 1.0, 0.0);
  clipPolygon(polygon, count, -1.0, length_);
  if (count < 3) return;
  for (int i = 0; i < count; ++i) {
    // Corners in the order of a strip: 0, 1, n - 1, 2, n - 2.
    int k = i == 0 ? 0 : (i & 1) == 1 ? (i + 1) / 2 : count - i / 2;
    vec4 p = polygon[k];
    vec3 at = p.xyz - p.w * sun;
    emitOnNearPlane(at - beforeNear(at) * forward);
  }
  EndPrimitive();
}

void emitWall(vec3 p, vec3 q, vec3 opposite, vec3 neighbour, vec3 along) {
  if (!(facing(q, p, neighbour) >= 0.0)) return;
  emitAt(p);
  emitAt(q);
  emitAt(p + along);
  emitAt(q + along);
  EndPrimitive();
}

void main() {
  vec3 a = corner[0], b = corner[2], c = corner[4];
  if (!(facing(a, b, c) < 0.0)) return;
  float length_ = alpenglowLightShaft.map.y;
  vec3 along = -length_ * alpenglowLightShaft.sunRange.xyz;
  // The volume's outside is towards the sun here, on the triangle's back.
  emitAt(a);
  emitAt(c);
  emitAt(b);
  EndPrimitive();
  emitAt(a + along);
  emitAt(b + along);
  emitAt(c + along);
  EndPrimitive();
  emitWall(a, b, c, corner[1], along);
  emitWall(b, c, a, corner[3], along);
  emitWall(c, a, b, corner[5], along);
  emitSection(a, b, c, length_);
}
