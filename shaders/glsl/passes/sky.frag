#version 460
#extension GL_GOOGLE_include_directive : require
// Sky, sun disc, ground sphere and the aerial perspective in front of it: equation 16 without shadows, from the
// ground to outer space. The constants below remove what no pixel of the draw shows.

layout(constant_id = 0) const bool kMiePacked = false;
layout(constant_id = 1) const bool kFisheye = false;
layout(constant_id = 2) const bool kGround = true;  // some pixels may see the ground
layout(constant_id = 3) const bool kSunDisc = true;
layout(constant_id = 5) const bool kAir = true;
layout(constant_id = 11) const float kSkyViewColumns = 128.0;
layout(constant_id = 12) const float kSkyViewRows = 160.0;

#include "common/effect_constants.glsl"

#ifdef ALPENGLOW_SKY_VIEW_LUT
// Light that arrives at this frame's camera, or (standard solver, cameras inside the atmosphere) S at its
// altitude: sky_view_lut.comp, sky_view_lut_standard.comp.
#include "physics/types.glsl"
#define ALPENGLOW_SKY_VIEW_READS
layout(set = 1, binding = 1) uniform sampler2D skyViewLut;
layout(set = 1, binding = 2) uniform sampler2D skyViewLutMie;
vec4 readSkyView(vec2 uv) { return textureLod(skyViewLut, uv, 0.0); }
Spectrum readSkyViewMie(vec2 uv) { return textureLod(skyViewLutMie, uv, 0.0).rgb; }
#endif

#define ALPENGLOW_MIE_PACKED kMiePacked
#include "alpenglow/atmosphere.glsl"
#include "common/observer.glsl"
#ifdef ALPENGLOW_WITH_LIGHT_SHAFTS
#define ALPENGLOW_AERIAL_PERSPECTIVE_SET 2
#define ALPENGLOW_LIGHT_SHAFT_SET 3
#include "alpenglow/light_shafts.glsl"
#include "common/ray_light.glsl"
#include "common/air_ray.glsl"
#include "common/light_shaft_loss.glsl"
#endif

#ifdef ALPENGLOW_ALBEDO_MAP
layout(set = 1, binding = 0) uniform sampler2D albedoMap;
#endif

// Directions in the planet's frame; mirrored by SkyConstants in atmosphere/passes/sky_pass.h.
layout(push_constant) uniform SkyConstants {
  vec4 upAltitude;      // the camera's vertical; altitude in metres
  vec4 forwardPixel;    // w: angle of a pixel at the centre, radians
  vec4 rightHalfAngle;  // scaled by tan(fov / 2) and aspect; fisheye: unit, half the circle's angle
  vec4 downMapTexel;    // scaled by tan(fov / 2), down the image; metres of a map texel
  vec4 sunDiscChord;    // towards the sun; chord to where the drawn disc's edge is at 1/2
  vec4 irradianceDisc;  // solar irradiance times radianceScale; the disc's radiance per unit of it
  vec4 circleSkyView;   // xy: ndc to units of the fisheye's circle; zw: SkyViewParams
  vec4 sunAzimuth;      // horizontal unit vector towards the sun; w: SkyViewParams
};

layout(location = 0) in vec2 ndc;
layout(location = 0) out vec4 radiance;

vec3 viewDirection(out bool visible, inout vec3 up, inout float altitude) {
  if (kFisheye) {
    vec2 p = ndc * circleSkyView.xy;
    float radius = length(p);
    float theta = radius * rightHalfAngle.w;
    visible = radius <= 1.00001;  // a pixel centre on the circle is inside, despite rounding
    vec2 across = p * (sin(theta) / max(radius, 1e-9));
    return normalize(forwardPixel.xyz * cos(theta) + rightHalfAngle.xyz * across.x +
                     downMapTexel.xyz * across.y);
  }
  visible = true;
  if (kOrthographic) {
    alpenglowMoveObserver(ndc.x * rightHalfAngle.xyz + ndc.y * downMapTexel.xyz, up, altitude);
    return forwardPixel.xyz;
  }
  return normalize(forwardPixel.xyz + ndc.x * rightHalfAngle.xyz + ndc.y * downMapTexel.xyz);
}

// Albedo where the ray meets the ground, `up` and `altitude` of its observer; of a map, at the level whose
// texels are as wide as the pixel's footprint there.
Spectrum groundAlbedo(Ray ray, vec3 up, float altitude, vec3 view, float muGround) {
#ifdef ALPENGLOW_ALBEDO_MAP
  vec3 point = up * (alpenglowMedium.bottomRadius + altitude) +
               view * (ray.start + ray.extent);
  vec3 n = normalize(point);
  vec2 uv = vec2(atan(n.y, n.x) * (0.5 / ALPENGLOW_PI) + 0.5,
                 acos(clamp(n.z, -1.0, 1.0)) / ALPENGLOW_PI);
  float width = kOrthographic ? forwardPixel.w : (ray.start + ray.extent) * forwardPixel.w;
  float footprint = width * inversesqrt(max(muGround, 0.05));
  return textureLod(albedoMap, uv, max(log2(footprint / downMapTexel.w), 0.0)).rgb;
#else
  return alpenglowMedium.groundAlbedo;
#endif
}

// The ground's own light times transmittance: T R[L], equations 10 and 14. `sunlit` is 0 in the
// shadow of a caster.
Spectrum groundTerm(Ray ray, vec3 up, float altitude, vec3 view, float sunlit) {
  float d = ray.hitsGround ? ray.extent : 0.0;
#ifdef ALPENGLOW_MARCHES
  Spectrum depth = alpenglowMarch(ray, d).depth;
#else
  Spectrum depth =
      opticalDepthToGround(alpenglowMedium, ray.h, ray.mu, d, ray.hitsGround);
#endif
  float muGround = -muAt(alpenglowMedium, ray.h, ray.mu, d, 0.0);
  float muSGround = muSAt(alpenglowMedium, ray.h, ray.muS, ray.nu, d, 0.0);
  Spectrum albedo = groundAlbedo(ray, up, altitude, view, muGround);
  Spectrum sun = alpenglowSunlight(0.0, muSGround) * (max(muSGround, 0.0) * sunlit);
  Spectrum light =
      reflectedRadiance(albedo, sun, alpenglowSkyIrradiance(0.0, muSGround)) * exp(-depth);
  return ray.hitsGround ? light : SPECTRUM(0.0);
}

// The sun's disc: T times irradiance over its solid angle, its edge one pixel wide. The angle comes
// from the chord between the directions: their dot product loses all digits at 0.27 degrees.
Spectrum discTerm(Ray ray, vec3 view) {
  float chord = length(view - sunDiscChord.xyz);
  float coverage = clamp((sunDiscChord.w - chord) / forwardPixel.w + 0.5, 0.0, 1.0);
  return alpenglowTransmittanceToSpace(ray) * (coverage * irradianceDisc.w);
}

#ifdef ALPENGLOW_SKY_VIEW_LUT
Spectrum skyViewTerm(Ray ray, vec3 view) {
#ifdef ALPENGLOW_SOLVER_STANDARD
  return scatteringOfRayInSkyView(alpenglowMedium, alpenglowShape, ray.h, ray.mu, ray.nu,
                                  ray.hitsGround);
#elif defined(ALPENGLOW_SOLVER_HILLAIRE)
  vec2 angles = skyViewAngles(upAltitude.xyz, sunAzimuth.xyz, view);
  vec2 at = skyViewCoordinate(circleSkyView.z, angles.x, angles.y, ray.hitsGround, kSkyViewColumns, kSkyViewRows);
  return readSkyView(at).rgb;
#else
  SkyViewParams skyView = SkyViewParams(circleSkyView.z, circleSkyView.w, sunAzimuth.w);
  vec2 angles = skyViewAngles(upAltitude.xyz, sunAzimuth.xyz, view);
  vec2 at = gridCoordinate(skyViewGrid(skyView, kSkyViewColumns, kSkyViewRows), skyView, angles.x, angles.y,
                           ray.hitsGround);
  Spectrum mieShare = SPECTRUM(0.0);
  float phase = 0.0;
  if (ALPENGLOW_MIE) {
    mieShare = readSkyViewMie(at);
    phase = miePhase(alpenglowMedium.mieAsymmetry, ray.nu);
  }
  Spectrum light = decodeSkyView(readSkyView(at).rgb, mieShare, phase);
  return ray.inAtmosphere ? light : SPECTRUM(0.0);
#endif
}
#endif

void main() {
  bool visible;
  vec3 up = upAltitude.xyz;
  float altitude = upAltitude.w;
  vec3 view = viewDirection(visible, up, altitude);
  Ray ray = alpenglowRay(up, altitude, view, sunDiscChord.xyz);
  if (!kGround) ray.hitsGround = false;
  if (!kAir) ray.inAtmosphere = false;
  Spectrum light = SPECTRUM(0.0);
#ifdef ALPENGLOW_SKY_VIEW_LUT
  if (kAir) light = skyViewTerm(ray, view);
#else
  if (kAir) light = alpenglowSkyRadiance(ray);
#endif
  float sunlit = 1.0;
#ifdef ALPENGLOW_WITH_LIGHT_SHAFTS
  if (kAir) {
    float end = ray.start + ray.extent;
    AerialRay aerial = aerialRayOf(ray, view);
    AerialLight whole = alpenglowAerialLight(aerial, end);
    light -= lightShaftLoss(gl_FragCoord.xy, aerial, view, ray.start, end, whole, ray.hitsGround);
    light = max(light, SPECTRUM(0.0));
    vec3 at = alpenglowRayOrigin(gl_FragCoord.xy) + end * view;
    sunlit = alpenglowSunlit(gl_FragCoord, at, upAltitude.xyz);
  }
#endif
  if (kGround) light += groundTerm(ray, up, altitude, view, sunlit);
  if (kSunDisc) light += discTerm(ray, view);
  light = visible ? light * irradianceDisc.rgb : SPECTRUM(0.0);
  radiance = vec4(light, 1.0);
}
