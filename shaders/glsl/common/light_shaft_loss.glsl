// Light that shadows remove from a ray: docs/light-shafts.md. Needs alpenglow/light_shafts.glsl, common/ray_light.glsl
// and common/observer.glsl.

layout(constant_id = 8) const int kLightShaftMethod = 0;
layout(constant_id = 9) const int kLightShaftSteps = 32;
// Share of multiple scattering that is lost where all single scattering is lost: docs/light-shafts.md.
layout(constant_id = 10) const float kMultipleLoss = 0.7;

// Multiple scattering is lost with the single scattering of the same ray only where single scattering is at least
// this share of it. At dusk single scattering is nearly zero, and the light of other parts of the sky remains.
const float kRelatedShare = 0.3;
Spectrum relatedShare(AerialLight light) {
  return min(light.single / max(kRelatedShare * light.multiple, SPECTRUM(1e-30)), SPECTRUM(1.0));
}

// Loss of single scattering, from the sum over the crossings of the ray with the light-volume mesh.
Spectrum lightVolumeLoss(vec2 fragCoord, Spectrum whole) {
  vec4 sums = texelFetch(alpenglowLightShaftSums, ivec2(fragCoord), 0);
  float start = alpenglowLightShaftBlocks.start;
  if (kOrthographic) start = alpenglowBehindLightVolumeMesh(alpenglowRayOrigin(fragCoord)) ? 1.0 : 0.0;
  float shadows = start + sums.a;
  Spectrum lit = sums.rgb + (shadows > 0.5 ? SPECTRUM(0.0) : whole);
  return whole - clamp(lit, SPECTRUM(0.0), whole);
}

// Loss of single scattering, from samples of the segment that lies within the shadow map.
Spectrum rayMarchLoss(vec2 fragCoord, AerialRay aerial, vec3 view, float end) {
  vec3 origin = alpenglowRayOrigin(fragCoord);
  vec3 from = alpenglowOnShadowMap(origin);
  vec3 step_ = alpenglowOnShadowMap(origin + view) - from;
  step_ += vec3(equal(step_, vec3(0.0))) * 1e-20;
  vec2 size = vec2(alpenglowLightShaft.map.x);
  vec2 a = -from.xy / step_.xy, b = (size - from.xy) / step_.xy;
  vec2 first = min(a, b), last = max(a, b);
  float begin = clamp(max(first.x, first.y), 0.0, end);
  float stop = clamp(min(last.x, last.y), begin, end);
  float width = (stop - begin) / float(kLightShaftSteps);
  Spectrum loss = SPECTRUM(0.0), before = alpenglowAerialSingle(aerial, begin);
  for (int i = 0; i < kLightShaftSteps; ++i) {
    float t = begin + width * (float(i) + 0.5);
    Spectrum after = alpenglowAerialSingle(aerial, begin + width * float(i + 1));
    loss += alpenglowInShadow(origin + t * view) ? after - before : SPECTRUM(0.0);
    before = after;
  }
  return max(loss, SPECTRUM(0.0));
}

// Equations 17 and 18 of the paper, for all orders: a ray that ends on a surface loses the light of its last
// metres, a ray to the sky that of its first.
Spectrum shadowVolumeLoss(vec2 fragCoord, AerialRay aerial, AerialLight whole, float end, float start, bool ground) {
  vec2 sums = texelFetch(alpenglowLightShaftSums, ivec2(fragCoord), 0).xy;
  vec2 bounds = texelFetch(alpenglowLightShaftBounds, ivec2(fragCoord), 0).xy;  // (-zmin, zmax)
  float zGround = max(end - start, 0.0);
  float zMin = min(-bounds.x, zGround);
  float onGround = clamp(sums.y - sums.x * zGround, 0.0, zGround - zMin);
  float inSky = clamp(sums.y, 0.0, bounds.y);
  AerialLight part = alpenglowAerialLight(aerial, start + (ground ? zGround - onGround : inSky));
  Spectrum single = ground ? max(whole.single - part.single, SPECTRUM(0.0)) : min(part.single, whole.single);
  Spectrum multiple = ground ? max(whole.multiple - part.multiple, SPECTRUM(0.0)) : min(part.multiple, whole.multiple);
  return single + relatedShare(whole) * multiple;
}

// Loss of `light`, the single and multiple scattering of the first `end` metres of a ray; `ground`: the ray ends
// on a surface.
Spectrum lightShaftLoss(vec2 fragCoord, AerialRay aerial, vec3 view, float start, float end, AerialLight light,
                        bool ground) {
  if (alpenglowLightShaft.pixels.z < 0.0) return SPECTRUM(0.0);
  if (kLightShaftMethod == kShadowVolume)
    return shadowVolumeLoss(fragCoord, aerial, light, end, start, ground);
  Spectrum single = kLightShaftMethod == kLightVolume ? lightVolumeLoss(fragCoord, light.single)
                                                      : rayMarchLoss(fragCoord, aerial, view, end);
  Spectrum share = min(single / max(light.single, SPECTRUM(1e-30)), SPECTRUM(1.0));
  return single + kMultipleLoss * relatedShare(light) * share * light.multiple;
}
