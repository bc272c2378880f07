// What a host's own shaders include to light a scene with Alpenglow's tables. Compile with the folder
// above on the include path and bind TablesInfo::set at set ALPENGLOW_SET (0 unless defined before).
// For tables of Solver::Standard define ALPENGLOW_SOLVER_STANDARD, and ALPENGLOW_MIE_PACKED as true for those with
// MieStorage::Packed (a bool, may be a specialization constant; false unless defined before); for those of a
// simpler model ALPENGLOW_SOLVER_HOFFMAN_PREETHAM, _ONEIL, _SCHAFHITZEL or _HILLAIRE.
//
// For tables made without effects (TableDesc::disabledEffects) define ALPENGLOW_WITHOUT_MULTIPLE or, without
// Mie, ALPENGLOW_WITHOUT_SOURCE: the binding of a missing table must not be declared. The macros of
// physics/effects.glsl, defined as false or as specialization constants, disable the other effects.
//
// Every answer is per unit solar irradiance, in the channels of the tables: multiply it with the
// sun's irradiance. Distances are metres, directions unit vectors, `up` the observer's vertical.
#ifndef ALPENGLOW_ATMOSPHERE
#define ALPENGLOW_ATMOSPHERE

#ifndef ALPENGLOW_SET
#define ALPENGLOW_SET 0
#endif
#ifndef ALPENGLOW_MIE_PACKED
#define ALPENGLOW_MIE_PACKED false
#endif

#ifdef ALPENGLOW_SOLVER_STANDARD
#define ALPENGLOW_TABLE_READS
#define ALPENGLOW_FINAL_READS
#include "physics/physics.glsl"
#include "alpenglow/standard_tables.glsl"
#elif defined(ALPENGLOW_SOLVER_HOFFMAN_PREETHAM) || defined(ALPENGLOW_SOLVER_ONEIL) || \
    defined(ALPENGLOW_SOLVER_SCHAFHITZEL) || defined(ALPENGLOW_SOLVER_HILLAIRE)
#define ALPENGLOW_TABLE_READS
#include "physics/physics.glsl"
#include "alpenglow/baseline_tables.glsl"
#else
#include "physics/physics.glsl"
#include "alpenglow/moment_tables.glsl"
#endif

// The part of a view ray that lies in the atmosphere, of an observer `altitude` metres above the
// ground sphere (on the ground or in space). Compute the altitude in double on the CPU.
Ray alpenglowRay(vec3 up, float altitude, vec3 view, vec3 sun) {
  float mu = dot(view, up);
  vec3 across = view - mu * up;
  return makeRay(alpenglowMedium, max(altitude, 0.0), mu, length(across), dot(sun, up),
                 dot(view, sun));
}

// Moves an observer by `offset` metres, and updates its vertical and altitude: for points of a scene, and for
// orthographic cameras, each pixel of which has an observer of its own. Below the ground the altitude is 0.
void alpenglowMoveObserver(vec3 offset, inout vec3 up, inout float altitude) {
  float d = length(offset);
  vec3 there = up * (alpenglowMedium.bottomRadius + altitude) + offset;
  altitude = altitudeAt(alpenglowMedium, altitude, dot(offset, up) / max(d, 1e-9), d);
  up = normalize(there);
}

// Radiance scattered in the atmosphere along the whole ray, to the ground or to space. No sun disc.
Spectrum alpenglowSkyRadiance(Ray ray) {
  Spectrum s = alpenglowLightOfRay(ray);
  return ray.inAtmosphere ? s : SPECTRUM(0.0);
}

// Metres of the ray inside the atmosphere, of `distance` metres from the observer.
float alpenglowInside(Ray ray, float distance_) {
  return ray.inAtmosphere ? clamp(distance_ - ray.start, 0.0, ray.extent) : 0.0;
}

// Transmittance between the observer and a point of the ray.
Spectrum alpenglowTransmittance(Ray ray, float distance_) {
  float inside = alpenglowInside(ray, distance_);
#ifdef ALPENGLOW_MARCHES
  return exp(-alpenglowMarch(ray, inside).depth);
#else
  return exp(-opticalDepthOfSegment(alpenglowMedium, ray.h, ray.mu, inside));
#endif
}

// Aerial perspective: radiance scattered in the atmosphere between the observer and a point of the ray, and
// the transmittance of that segment. Use it before blending for transparent objects.
Spectrum alpenglowRadianceToPoint(Ray ray, float distance_, out Spectrum transmittance) {
  float inside = alpenglowInside(ray, distance_);
#ifdef ALPENGLOW_MARCHES
  BaselineLight march = alpenglowMarch(ray, inside);
  transmittance = exp(-march.depth);
  Spectrum s = march.light;
#else
  transmittance = alpenglowTransmittance(ray, distance_);
  Spectrum s = alpenglowLightOfSegment(ray, inside, transmittance);
#endif
  return inside > 0.0 ? s : SPECTRUM(0.0);
}

// Transmittance from the observer to what the ray meets at its end: space, or the sun's disc.
Spectrum alpenglowTransmittanceToSpace(Ray ray) {
  Spectrum t = alpenglowTransmittanceOfRay(ray);
  return ray.hitsGround ? SPECTRUM(0.0) : (ray.inAtmosphere ? t : SPECTRUM(1.0));
}

// Irradiance at an altitude inside the atmosphere where the sun's zenith cosine is muS: sunlight on a surface
// that faces the sun, and sky light on a horizontal surface.
void alpenglowSunAndSkyIrradiance(float altitude, float muS, out Spectrum sun, out Spectrum sky) {
  sun = alpenglowSunlight(altitude, muS);
  sky = alpenglowSkyIrradiance(altitude, muS);
}

// Light that a Lambertian ground at altitude 0 sends up.
Spectrum alpenglowGroundRadiance(Spectrum albedo, float muS) {
  return reflectedRadiance(albedo, alpenglowSunlight(0.0, muS) * max(muS, 0.0),
                           alpenglowSkyIrradiance(0.0, muS));
}

#endif  // ALPENGLOW_ATMOSPHERE
