// Rays in a spherical shell. A point is given by its altitude h = r - Rg, never by r alone: in float
// r has steps of 0.5 m on Earth, and r^2 - Rg^2 would cancel (rho would be 3 % off at 2 m). mu is the
// cosine of the view zenith angle, mu_s of the sun's, nu between view and sun.

ALPENGLOW_FN Real radiusAt(IN(Medium) m, Real h) { return m.bottomRadius + h; }

ALPENGLOW_FN Real topRadius(IN(Medium) m) { return m.bottomRadius + m.thickness; }

// rho^2 = r^2 - Rg^2, the squared length of the tangent from the point to the ground.
ALPENGLOW_FN Real rhoSquared(IN(Medium) m, Real h) {
  return h * (REAL(2.0) * m.bottomRadius + h);
}

ALPENGLOW_FN Real horizonRho(IN(Medium) m, Real h) { return sqrt(rhoSquared(m, h)); }

// Cosine of the zenith angle of the horizon seen from h: mu_h = -rho / r.
ALPENGLOW_FN Real horizonMu(IN(Medium) m, Real h) { return -horizonRho(m, h) / radiusAt(m, h); }

// H^2 - rho^2 = Rt^2 - r^2 for a point inside the atmosphere.
ALPENGLOW_FN Real topGapSquared(IN(Medium) m, Real h) {
  return max((m.thickness - h) * (REAL(2.0) * m.bottomRadius + m.thickness + h), REAL(0.0));
}

// Whether the ray meets the ground; a tangent ray misses. Decide once for a ray and pass the answer
// on: taken again further along, it flips from rounding.
ALPENGLOW_FN bool rayHitsGround(IN(Medium) m, Real h, Real mu) {
  Real rMu = radiusAt(m, h) * mu;
  return mu < REAL(0.0) && rMu * rMu > rhoSquared(m, h);
}

// Distance to the ground of a ray that hits it: -r mu - sqrt(Delta), Delta = r^2 mu^2 - rho^2,
// written so that it does not cancel. Finite, but meaningless, for other rays.
ALPENGLOW_FN Real distanceToGround(IN(Medium) m, Real h, Real mu) {
  Real rMu = radiusAt(m, h) * mu;
  Real rho2 = rhoSquared(m, h);
  Real delta = max(rMu * rMu - rho2, REAL(0.0));
  return rho2 / max(sqrt(delta) - rMu, REAL(1e-6));
}

// Distance to the top from a point inside, looking through the ground where it is in the way:
// -r mu + sqrt(r^2 mu^2 + Rt^2 - r^2).
ALPENGLOW_FN Real distanceToTop(IN(Medium) m, Real h, Real mu) {
  Real rMu = radiusAt(m, h) * mu;
  Real gap2 = topGapSquared(m, h);
  Real root = sqrt(rMu * rMu + gap2);
  return rMu > REAL(0.0) ? gap2 / (rMu + root) : root - rMu;
}

// Altitude after a distance t: h + (t^2 + 2 r mu t) / (r_t + r); negative inside the ground.
ALPENGLOW_FN Real signedAltitudeAt(IN(Medium) m, Real h, Real mu, Real t) {
  Real r = radiusAt(m, h);
  Real gain = t * (t + REAL(2.0) * r * mu);
  Real rt = sqrt(max(r * r + gain, REAL(0.0)));
  return h + gain / (rt + r);
}

// The same for rays above the ground, where rounding must not make it negative.
ALPENGLOW_FN Real altitudeAt(IN(Medium) m, Real h, Real mu, Real t) {
  return max(signedAltitudeAt(m, h, mu, t), REAL(0.0));
}

// Zenith cosines of the view and of the sun after a distance t, at altitude ht = altitudeAt(t).
ALPENGLOW_FN Real muAt(IN(Medium) m, Real h, Real mu, Real t, Real ht) {
  return clamp((radiusAt(m, h) * mu + t) / radiusAt(m, ht), REAL(-1.0), REAL(1.0));
}

ALPENGLOW_FN Real muSAt(IN(Medium) m, Real h, Real muS, Real nu, Real t, Real ht) {
  return clamp((radiusAt(m, h) * muS + t * nu) / radiusAt(m, ht), REAL(-1.0), REAL(1.0));
}

// nu limited to what mu and mu_s allow.
ALPENGLOW_FN Real clampNu(Real mu, Real muS, Real nu) {
  Real spread = sqrt(max((REAL(1.0) - mu * mu) * (REAL(1.0) - muS * muS), REAL(0.0)));
  return clamp(nu, max(mu * muS - spread, REAL(-1.0)), min(mu * muS + spread, REAL(1.0)));
}

// Fraction of the sun's uniform disc above the planet's horizon, taken as straight over the disc's
// width. A parallel beam (radius 0) steps from 0 to 1.
ALPENGLOW_FN Real sunVisibility(IN(Medium) m, Real h, Real muS) {
  Real r = radiusAt(m, h);
  // Sine of the sun's angle above the horizon.
  Real sine = (muS * m.bottomRadius +
               sqrt(max(REAL(1.0) - muS * muS, REAL(0.0))) * horizonRho(m, h)) / r;
  Real x = clamp(sine / max(m.sunSinRadius, REAL(1e-20)), REAL(-1.0), REAL(1.0));
  return REAL(0.5) +
         (x * sqrt(max(REAL(1.0) - x * x, REAL(0.0))) + asin(x)) / REAL(ALPENGLOW_PI);
}

// A ray from where it is, or enters the atmosphere, to the ground or the top.
struct Ray {
  Real start;  // distance from the observer to where the ray begins, 0 inside the atmosphere
  Real h;
  Real mu;
  Real muS;
  Real nu;
  Real extent;       // distance to the ground or the top
  bool hitsGround;
  bool inAtmosphere;  // false: the ray misses the atmosphere, and nothing else counts
};

// The ray of an observer at altitude h, in space too. sine is the sine of the view zenith angle:
// given apart, because far out 1 - mu^2 has lost the impact parameter b = r sine.
ALPENGLOW_FN Ray makeRay(IN(Medium) m, Real h, Real mu, Real sine, Real muS, Real nu) {
  Ray ray;
  Real r = radiusAt(m, h);
  Real rt = topRadius(m);
  bool inside = !ALPENGLOW_SPACE_VIEWS || h <= m.thickness;
  Real b = r * sine;
  Real half_ = sqrt(max((rt - b) * (rt + b), REAL(0.0)));  // half the chord through the shell
  ray.start = inside ? REAL(0.0) : max(-r * mu - half_, REAL(0.0));
  ray.h = inside ? h : m.thickness;
  ray.mu = inside ? mu : -half_ / rt;
  ray.muS = inside ? muS : clamp((r * muS + ray.start * nu) / rt, REAL(-1.0), REAL(1.0));
  ray.nu = nu;
  ray.inAtmosphere = inside || (mu < REAL(0.0) && b < rt);
  ray.hitsGround = inside ? rayHitsGround(m, h, mu) : (mu < REAL(0.0) && b < m.bottomRadius);
  ray.extent = ray.hitsGround ? distanceToGround(m, ray.h, ray.mu) : distanceToTop(m, ray.h, ray.mu);
  return ray;
}
