#version 460
#extension GL_GOOGLE_include_directive : require
// The surface between light and shadow: the map from the sun as a relief along the sun's beam, a strip of
// triangles for each row of texels. Where casters are lit it lies on them; between, it is the walls of their
// shadows.

#include "alpenglow/shafts.glsl"

layout(location = 0) out vec3 position;  // metres from the camera

void main() {
  ivec2 texel = ivec2(gl_VertexIndex >> 1, gl_InstanceIndex + (gl_VertexIndex & 1));
  position = alpenglowShadowVertex(texel);
  gl_Position = alpenglowShaft.clipFromCamera * vec4(position, 1.0);
}
