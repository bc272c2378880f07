layout(push_constant) uniform Balloon {
  vec4 centerRadius;  // from the camera
  vec4 upright;       // the vertical at its place
  vec4 colorOpacity;
} balloon;
