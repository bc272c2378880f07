#version 460
#extension GL_GOOGLE_include_directive : require
// Aerial perspective over a host's scene: equation 16 for what the depth image shows, from the ground to outer
// space. Blended: destination times `transmittance` plus `scattered`.

#define ALPENGLOW_AERIAL_PERSPECTIVE_SET 2
#define ALPENGLOW_LIGHT_SHAFT_SET 3
#include "common/effect_constants.glsl"
#include "alpenglow/atmosphere.glsl"
#include "common/observer.glsl"
#include "common/ray_light.glsl"
#ifdef ALPENGLOW_WITH_LIGHT_SHAFTS
#include "alpenglow/light_shafts.glsl"
#include "common/light_shaft_loss.glsl"
#endif

layout(constant_id = 4) const float kFarDepth = 1.0;

layout(set = 1, binding = 3) uniform sampler2D sceneDepth;

// Mirrored by AerialPerspectiveConstants in atmosphere/passes/sky_pass.h; directions in the planet's frame.
layout(push_constant) uniform AerialPerspectiveConstants {
  vec4 upAltitude;       // the camera's vertical; altitude in metres
  vec4 forwardA;         // w: depth is a + b / z (perspective) or a + b z
  vec4 rightB;           // forward + x right + y down is the ray at (x, y) of the picture, or x right + y down
  vec4 downExtinction;   // its origin; w: AerialView::extinction_
  vec4 sunHeight;        // towards the sun; w: AerialView::height
  vec4 irradiance;       // solar irradiance times radianceScale
  vec4 skyView;          // SkyViewParams; w: AerialView::startHeight
  vec4 sunAzimuth;       // horizontal unit vector towards the sun
};

layout(location = 0) in vec2 ndc;
layout(location = 0, index = 0) out vec4 scattered;
layout(location = 0, index = 1) out vec4 transmittance;

void main() {
  float depth = texelFetch(sceneDepth, ivec2(gl_FragCoord.xy), 0).r;
  bool covered = depth != kFarDepth;
  vec3 across = ndc.x * rightB.xyz + ndc.y * downExtinction.xyz;
  vec3 up = upAltitude.xyz, view = forwardA.xyz;
  float altitude = upAltitude.w;
  float t;
  if (kOrthographic) {
    alpenglowMoveObserver(across, up, altitude);
    t = (depth - forwardA.w) / rightB.w;
  } else {
    vec3 direction = view + across;
    view = normalize(direction);
    t = rightB.w / (covered ? depth - forwardA.w : 1.0) * length(direction);
  }
  Ray ray = alpenglowRay(up, altitude, view, sunHeight.xyz);
#ifdef ALPENGLOW_FROM_AERIAL_PERSPECTIVE_LUT
  AerialView aerialView_ = AerialView(SkyViewParams(skyView.x, skyView.y, skyView.z), downExtinction.w, skyView.w,
                                      sunHeight.w);
  AerialRay aerial = alpenglowAerialRay(aerialView_, up, sunAzimuth.xyz, ray, view);
#else
  AerialRay aerial = AerialRay(ray);
#endif
  AerialLight light = alpenglowAerialLight(aerial, t);
  Spectrum radiance = light.single + light.multiple;
#ifdef ALPENGLOW_WITH_LIGHT_SHAFTS
  radiance -= lightShaftLoss(gl_FragCoord.xy, aerial, view, ray.start, t, light, true);
#endif
  scattered = vec4(covered ? radiance * irradiance.rgb : SPECTRUM(0.0), 0.0);
  transmittance = vec4(covered ? exp(-light.depth) : SPECTRUM(1.0), 1.0);
}
