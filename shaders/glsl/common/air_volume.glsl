// Light of the air between a camera and any point that it sees, from the air volume of this frame: a few
// fetches where alpenglowRadianceToPoint integrates. The library's own passes read it; its set is not public.
// Include it after alpenglow/atmosphere.glsl (tables of Solver::Moments). The volume's images are combined
// image samplers at set ALPENGLOW_AIR_SET (1 unless defined before), bindings ALPENGLOW_AIR_BINDING (0) and
// the next two.
#ifndef ALPENGLOW_AIR_VOLUME
#define ALPENGLOW_AIR_VOLUME

#ifndef ALPENGLOW_AIR_SET
#define ALPENGLOW_AIR_SET 1
#endif
#ifndef ALPENGLOW_AIR_BINDING
#define ALPENGLOW_AIR_BINDING 0
#endif

layout(set = ALPENGLOW_AIR_SET, binding = ALPENGLOW_AIR_BINDING + 0) uniform sampler3D
    alpenglowAirFirst;
layout(set = ALPENGLOW_AIR_SET, binding = ALPENGLOW_AIR_BINDING + 1) uniform sampler3D
    alpenglowAirSecond;
layout(set = ALPENGLOW_AIR_SET, binding = ALPENGLOW_AIR_BINDING + 2) uniform sampler3D
    alpenglowAirThird;

// What arrives at the camera, per unit solar irradiance, from a stretch of a ray that begins there.
struct AirLight {
  Spectrum single;    // one event, phase functions applied
  Spectrum multiple;  // all others
  Spectrum depth;     // optical depth: what lies behind is dimmed by exp(-depth)
};

// A view ray in the volume: made once for a pixel, asked at as many distances as needed.
struct AirRay {
  vec2 direction;  // texture coordinate
  AirStretch stretch;
  float start;     // metres from the camera to the air
  float rayleigh, mie;  // phase functions
  bool any_;
};

// `view`, the camera's vertical `up` and `sunAzimuth` are those of AirVolume::view(); `direction` is the
// unit vector that the ray was made from.
AirRay alpenglowAirRay(AirView view, vec3 up, vec3 sunAzimuth, Ray ray, vec3 direction) {
  AirRay air;
  vec2 angles = sliceAngles(up, sunAzimuth, direction);
  air.direction =
      gridCoordinate(airGrid(view.slice), view.slice, angles.x, angles.y, ray.hitsGround);
  air.stretch = airStretch(alpenglowMedium, view, ray);
  air.start = ray.start;
  air.rayleigh = rayleighPhase(ray.nu);
  air.mie = miePhase(alpenglowMedium.mieAsymmetry, ray.nu);
  air.any_ = ray.inAtmosphere;
  return air;
}

// Texture coordinate at `inside` metres of the ray, counted from where it enters the air.
vec3 alpenglowAirCoordinate(AirRay ray, float inside) {
  return vec3(ray.direction, airCoordinate(ray.stretch, inside));
}

float alpenglowAirInside(AirRay ray, float distance_) {
  return ray.any_ ? clamp(distance_ - ray.start, 0.0, ray.stretch.extent) : 0.0;
}

// Light of the first `distance_` metres from the camera.
AirLight alpenglowAirLight(AirRay ray, float distance_) {
  float inside = alpenglowAirInside(ray, distance_);
  vec3 at = alpenglowAirCoordinate(ray, inside);
  vec4 first = textureLod(alpenglowAirFirst, at, 0.0);
  vec4 second = textureLod(alpenglowAirSecond, at, 0.0);
  vec4 third = textureLod(alpenglowAirThird, at, 0.0);
  float mean = airMeanDepth(first, inside);
  AirLight light;
  light.single = airSingle(first, second, mean, ray.rayleigh, ray.mie);
  light.multiple = airMultiple(third, mean);
  light.depth = airDepth(second, third, mean);
  return light;
}

// Its single scattering alone. What a stretch from a to b sends to the camera is the difference of two such:
// for the sunlit ones between the shadows of a ray.
Spectrum alpenglowAirSingle(AirRay ray, float distance_) {
  float inside = alpenglowAirInside(ray, distance_);
  vec3 at = alpenglowAirCoordinate(ray, inside);
  vec4 first = textureLod(alpenglowAirFirst, at, 0.0);
  return airSingle(first, textureLod(alpenglowAirSecond, at, 0.0), airMeanDepth(first, inside),
                   ray.rayleigh, ray.mie);
}

#endif  // ALPENGLOW_AIR_VOLUME
