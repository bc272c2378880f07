#version 460
// What a host draws into its depth image.
layout(location = 0) in vec3 position;
layout(push_constant) uniform Host {
  mat4 clipFromCamera;
  vec4 fromCamera;  // of the mesh's origin
};
void main() { gl_Position = clipFromCamera * vec4(position + fromCamera.xyz, 1.0); }
