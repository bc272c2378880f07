#version 460
#extension GL_GOOGLE_include_directive : require
// A balloon's envelope, without vertex buffers: half a sphere above, half an ellipsoid below. Six vertices for
// each of kAround x kDown cells.
#include "scene_frame.glsl"
#include "balloon.glsl"

const int kAround = 48;
const int kDown = 32;
const float kStretch = 1.4;  // of the lower half
const ivec2 kCorners[6] = ivec2[](ivec2(0, 0), ivec2(0, 1), ivec2(1, 0), ivec2(1, 0), ivec2(0, 1),
                                  ivec2(1, 1));

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out float gore;  // counts the strips of cloth

void main() {
  int cell = gl_VertexIndex / 6;
  ivec2 corner = ivec2(cell % kAround, cell / kAround) + kCorners[gl_VertexIndex % 6];
  float around = 2.0 * kPi * float(corner.x) / float(kAround);
  float down = kPi * float(corner.y) / float(kDown);
  float stretch = 2 * corner.y > kDown ? kStretch : 1.0;

  vec3 up = balloon.upright.xyz;
  vec3 east = normalize(abs(up.z) < 0.9 ? cross(vec3(0.0, 0.0, 1.0), up) : cross(vec3(1.0, 0.0, 0.0), up));
  vec3 outwards = cos(around) * east + sin(around) * cross(up, east);
  position = balloon.centerRadius.xyz +
             balloon.centerRadius.w * (sin(down) * outwards + stretch * cos(down) * up);
  normal = normalize(sin(down) * outwards + cos(down) / stretch * up);
  gore = 0.25 * float(corner.x);
  gl_Position = frame.clipFromCamera * vec4(position, 1.0);
}
