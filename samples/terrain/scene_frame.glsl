// What the shaders of a host's scene share: this frame's camera and sun. The library's tables are set 0, light
// shafts set 3. Positions are metres from the camera, in axes parallel to the planet's frame.

layout(set = 1, binding = 0, std140) uniform SceneFrame {
  mat4 clipFromCamera;
  vec4 upAltitude;       // the camera's vertical; altitude in metres
  vec4 forwardParallel;  // where it looks; 1: orthographic
  vec4 sun;              // towards it
  vec4 irradiance;       // of the sun above the atmosphere, times radianceScale
} frame;

const float kPi = 3.14159265;
