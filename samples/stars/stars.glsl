// What the shaders of stars share. Directions are in the axes of the catalogue: the planet's, turned by the
// sidereal time.

layout(push_constant) uniform StarView {
  vec4 rightAltitude;    // to the right in the picture; metres
  vec4 downFocal;        // down the picture; pixels per radian at its centre
  vec4 forwardFisheye;   // where the camera looks; half the fisheye's circle in radians, 0: perspective
  vec4 up;               // the camera's vertical
  vec4 irradiance;       // of the sun above the atmosphere, times radianceScale
  vec4 viewport;         // first pixel; width and height
} view;

// Reversed: behind everything.
const float kFarDepth = 0.0;
