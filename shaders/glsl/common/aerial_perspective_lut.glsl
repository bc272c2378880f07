// Light of the atmosphere between a camera and any point that it sees, from the aerial-perspective LUT of this
// frame: a few fetches where alpenglowRadianceToPoint integrates. Only the library's own passes read it. Include
// it after alpenglow/atmosphere.glsl (tables of Solver::Moments). The LUT's images are
// combined image samplers at set ALPENGLOW_AERIAL_PERSPECTIVE_SET (1 unless defined before), bindings
// ALPENGLOW_AERIAL_PERSPECTIVE_BINDING (0) and the next two.
#ifndef ALPENGLOW_AERIAL_PERSPECTIVE_LUT
#define ALPENGLOW_AERIAL_PERSPECTIVE_LUT

#ifndef ALPENGLOW_AERIAL_PERSPECTIVE_SET
#define ALPENGLOW_AERIAL_PERSPECTIVE_SET 1
#endif
#ifndef ALPENGLOW_AERIAL_PERSPECTIVE_BINDING
#define ALPENGLOW_AERIAL_PERSPECTIVE_BINDING 0
#endif

layout(set = ALPENGLOW_AERIAL_PERSPECTIVE_SET, binding = ALPENGLOW_AERIAL_PERSPECTIVE_BINDING + 0) uniform sampler3D
    alpenglowAerialFirst;
layout(set = ALPENGLOW_AERIAL_PERSPECTIVE_SET, binding = ALPENGLOW_AERIAL_PERSPECTIVE_BINDING + 1) uniform sampler3D
    alpenglowAerialSecond;
layout(set = ALPENGLOW_AERIAL_PERSPECTIVE_SET, binding = ALPENGLOW_AERIAL_PERSPECTIVE_BINDING + 2) uniform sampler3D
    alpenglowAerialThird;

// What arrives at the camera, per unit solar irradiance, from a segment of a ray that begins there.
struct AerialLight {
  Spectrum single;    // one event, phase functions applied
  Spectrum multiple;  // all others
  Spectrum depth;     // optical depth: what lies behind is dimmed by exp(-depth)
};

// A view ray in the LUT: made once for a pixel, then looked up at any number of distances.
struct AerialRay {
  vec2 direction;  // texture coordinate
  AerialSegment segment;
  float start;  // metres from the camera to the atmosphere
  float rayleigh, mie;  // phase functions
  bool any_;
};

// `view` and `sunAzimuth` are those of passes::aerialPerspectiveLookup, `up` is the camera's vertical; `direction`
// is the unit vector that the ray was made from.
AerialRay alpenglowAerialRay(AerialView view, vec3 up, vec3 sunAzimuth, Ray ray, vec3 direction) {
  AerialRay aerial;
  vec2 angles = skyViewAngles(up, sunAzimuth, direction);
  aerial.direction =
      gridCoordinate(aerialGrid(view.skyView), view.skyView, angles.x, angles.y, ray.hitsGround);
  aerial.segment = aerialSegment(alpenglowMedium, view, ray);
  aerial.start = ray.start;
  aerial.rayleigh = rayleighPhase(ray.nu);
  aerial.mie = miePhase(alpenglowMedium.mieAsymmetry, ray.nu);
  aerial.any_ = ray.inAtmosphere;
  return aerial;
}

// Texture coordinate at `inside` metres of the ray, counted from where it enters the atmosphere.
vec3 alpenglowAerialCoordinate(AerialRay ray, float inside) {
  return vec3(ray.direction, aerialCoordinate(ray.segment, inside));
}

float alpenglowAerialInside(AerialRay ray, float distance_) {
  return ray.any_ ? clamp(distance_ - ray.start, 0.0, ray.segment.extent) : 0.0;
}

// Light of the first `distance_` metres from the camera.
AerialLight alpenglowAerialLight(AerialRay ray, float distance_) {
  float inside = alpenglowAerialInside(ray, distance_);
  vec3 at = alpenglowAerialCoordinate(ray, inside);
  vec4 first = textureLod(alpenglowAerialFirst, at, 0.0);
  vec4 second = textureLod(alpenglowAerialSecond, at, 0.0);
  vec4 third = textureLod(alpenglowAerialThird, at, 0.0);
  float mean = aerialMeanDepth(first, inside);
  AerialLight light;
  light.single = aerialSingle(first, second, mean, ray.rayleigh, ray.mie);
  light.multiple = aerialMultiple(third, mean);
  light.depth = aerialDepth(second, third, mean);
  return light;
}

// The single scattering alone. The light of a segment from a to b is the difference of its values at b and a:
// for the sunlit segments between the shadows on a ray.
Spectrum alpenglowAerialSingle(AerialRay ray, float distance_) {
  float inside = alpenglowAerialInside(ray, distance_);
  vec3 at = alpenglowAerialCoordinate(ray, inside);
  vec4 first = textureLod(alpenglowAerialFirst, at, 0.0);
  return aerialSingle(first, textureLod(alpenglowAerialSecond, at, 0.0), aerialMeanDepth(first, inside),
                      ray.rayleigh, ray.mie);
}

#endif  // ALPENGLOW_AERIAL_PERSPECTIVE_LUT
