#version 460
// A triangle that covers the viewport, at the far plane.

layout(constant_id = 4) const float kFarDepth = 1.0;

layout(location = 0) out vec2 ndc;

void main() {
  ndc = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  gl_Position = vec4(ndc, kFarDepth, 1.0);
}
