// The aerial-perspective LUT of a camera: light and optical depth of the first metres of all its rays, over
// direction (physics/sky_view_lut.glsl) and distance, rebuilt for each camera and sun. It answers for any
// distance, from metres to the end of the ray, wherever the camera is.

const int kAerialColumns = 128;
const int kAerialRows = 96;
const int kAerialDistances = 56;

// What the mappings need, the same for all rays of a camera: aerialView.
struct AerialView {
  SkyViewParams skyView;
  Real extinction_;  // where rays begin, 1/m, the greatest of the channels
  Real startHeight;  // scale height of the atmosphere there, m
  Real height;       // the least scale height, m
};

ALPENGLOW_FN AerialView aerialView(IN(Medium) m, IN(SkyViewParams) skyView, Real altitude) {
  AerialView view;
  Spectrum e = extinction(m, min(altitude, m.thickness));
  view.skyView = skyView;
  view.extinction_ = max(max(e[0], e[1]), e[2]);
  view.startHeight = localScaleHeight(m, min(altitude, m.thickness));
  view.height = min(m.rayleighScaleHeight, m.mieScaleHeight);
  return view;
}

// Inside the atmosphere the sky next to the horizon needs most rows; in space the ground does.
ALPENGLOW_FN DirectionGrid aerialGrid(IN(SkyViewParams) view) {
  DirectionGrid grid;
  grid.groundRows = viewFromSpace(view) ? REAL(57.0) : REAL(32.0);
  grid.rows = Real(kAerialRows);
  grid.columns = azimuthColumns(view, Real(kAerialColumns));
  grid.width = Real(kAerialColumns) * (ALPENGLOW_SPACE_VIEWS ? REAL(1.0) : REAL(0.5));
  return grid;
}

// Mapping of distances along a ray to w in [0, 1]: dw/dt is the sum of 1 / (near + t), for extinction on the way
// and for rays that leave the atmosphere, and of 1 / (far + extent - t) for rays that hit the ground, or else
// 1 / sqrt(far^2 + (t - lowest)^2), where `far` is about the distance from its lowest point within which a ray
// stays in the dense part of the atmosphere.
struct AerialSegment {
  Real extent;
  Real near_;
  Real far_;
  Real lowest;
  bool hitsGround;
  Real start;  // the second term's exponential at t = 0
  Real range;
};

ALPENGLOW_FN Real aerialTurn(IN(AerialSegment) a, Real t) {
  Real end = a.far_ + a.extent;
  Real x = (t - a.lowest) / a.far_;
  Real root = sqrt(x * x + REAL(1.0));
  Real turn = x < REAL(0.0) ? REAL(1.0) / (root - x) : root + x;
  return a.hitsGround ? end / (end - t) : turn;
}

ALPENGLOW_FN AerialSegment aerialSegment(IN(Medium) m, IN(AerialView) view, IN(Ray) ray) {
  AerialSegment a;
  Real rMu = radiusAt(m, ray.h) * ray.mu;
  Real gain2 = view.height * (REAL(2.0) * m.bottomRadius + view.height);
  Real endMu = max(-(rMu + ray.extent), REAL(0.0));  // times Rg, of one that hits the ground
  a.extent = max(ray.extent, REAL(1e-3));
  a.near_ = REAL(1.0) / (view.extinction_ + abs(ray.mu) / view.startHeight + REAL(1e-12));
  a.far_ = ray.hitsGround ? gain2 / (endMu + sqrt(endMu * endMu + gain2)) : sqrt(gain2);
  a.lowest = max(-rMu, REAL(0.0));
  a.hitsGround = ray.hitsGround;
  a.start = aerialTurn(a, REAL(0.0));
  // Rays of no length have no range, but must not be divided by it.
  a.range = max(log((REAL(1.0) + a.extent / a.near_) * aerialTurn(a, a.extent) / a.start), REAL(1e-6));
  return a;
}

ALPENGLOW_FN Real aerialU(IN(AerialSegment) a, Real t) {
  Real inside = clamp(t, REAL(0.0), a.extent);
  return clamp(log((REAL(1.0) + inside / a.near_) * aerialTurn(a, inside) / a.start) / a.range, REAL(0.0),
               REAL(1.0));
}

// The inverse: a linear equation for rays that hit the ground, for others a quadratic equation for the second
// term's exponential.
ALPENGLOW_FN Real aerialDistance(IN(AerialSegment) a, Real w) {
  Real q = exp(w * a.range);
  Real end = a.far_ + a.extent;
  Real sinking = (q - REAL(1.0)) * end / (end / a.near_ + q);
  Real half_ = REAL(0.5) * a.far_ / a.near_;
  Real b = REAL(1.0) + a.lowest / a.near_;
  Real c = half_ + q * a.start;
  Real x = REAL(2.0) * c / (b + sqrt(b * b + REAL(4.0) * half_ * c));
  Real rising = a.lowest + REAL(0.5) * a.far_ * (x - REAL(1.0) / x);
  Real t = a.hitsGround ? sinking : rising;
  return w < REAL(1.0) ? clamp(t, REAL(0.0), a.extent) : a.extent;
}

// Distance of texel i. The first texel stands for the ray's beginning and holds means over a tiny distance. Never
// 0, however the shortest rays are rounded.
ALPENGLOW_FN Real aerialTexelDistance(IN(AerialSegment) a, int i) {
  Real w = max(texelToU(Real(i), Real(kAerialDistances)), REAL(0.01) / Real(kAerialDistances));
  return max(aerialDistance(a, w), REAL(1e-3) * w * a.extent);
}

// Texture coordinate of a distance.
ALPENGLOW_FN Real aerialCoordinate(IN(AerialSegment) a, Real t) {
  return insetCoordinate(aerialU(a, t), Real(kAerialDistances));
}

// A texel holds ratios to the optical depth, which hardly change from texel to texel and have a limit at
// distance 0: the mean depth over the channels, per metre, and relative to it the depth of two channels and light.
// Values that may fall by orders of magnitude from texel to texel, across the terminator, are logarithms. Single
// scattering is the sum of Rayleigh and Mie without phase functions, and the Mie share of it. In the planet's
// shadow it is 0, so its logarithm has a floor far below daylight, which is subtracted after the lookup.
ALPENGLOW_FN Real aerialFloor() { return REAL(1e-4); }

ALPENGLOW_FN void encodeAerialPerspective(Spectrum rayleigh, Spectrum mie, Spectrum multiple, Spectrum depth, Real t,
                                          OUT(Real4) first, OUT(Real4) second, OUT(Real4) third) {
  Real mean = max((depth[0] + depth[1] + depth[2]) / REAL(3.0), kMinRadiance * t);
  Spectrum floored = (rayleigh + mie) / mean + aerialFloor();
  Spectrum s = log(floored);
  Spectrum share = mie / mean / floored;
  Spectrum mu = log(max(multiple / mean, SPECTRUM(kMinRadiance)));
  first = Real4(s[0], s[1], s[2], log(mean / t));
  second = Real4(share[0], share[1], share[2], depth[1] / mean);
  third = Real4(mu[0], mu[1], mu[2], depth[2] / mean);
}

// Decodes the first t metres: mean optical depth; single scattering; multiple scattering; optical depth.
ALPENGLOW_FN Real aerialMeanDepth(Real4 first, Real t) { return exp(first[3]) * t; }

ALPENGLOW_FN Spectrum aerialSingle(Real4 first, Real4 second, Real mean, Real phaseRayleigh,
                                   Real phaseMie) {
  Spectrum floored = exp(Spectrum(first[0], first[1], first[2]));
  Spectrum mie = Spectrum(second[0], second[1], second[2]) * floored;
  Spectrum rayleigh = max(floored - aerialFloor() - mie, SPECTRUM(REAL(0.0)));
  return (rayleigh * phaseRayleigh + mie * phaseMie) * mean;
}

ALPENGLOW_FN Spectrum aerialMultiple(Real4 third, Real mean) {
  return exp(Spectrum(third[0], third[1], third[2])) * mean;
}

ALPENGLOW_FN Spectrum aerialDepth(Real4 second, Real4 third, Real mean) {
  return Spectrum(max(REAL(3.0) - second[3] - third[3], REAL(0.0)), second[3], third[3]) * mean;
}
