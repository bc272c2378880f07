// Light along a ray, by quadrature. A ray is cut where its integrand is not smooth: at its lowest point and at
// the edges of the planet's shadow; each segment is reparametrised so that the nodes lie where the atmosphere
// is, and divided into panels of two Gauss points. The optical depth from the observer is summed up on the way,
// never taken as a difference: a segment of a metre keeps its digits.

// Where the ray x + t v passes the edge of the planet's shadow, a half cylinder of radius Rg behind the
// terminator: 0 for no such place. Rays that hit the ground end there.
ALPENGLOW_FN Real2 shadowEdges(IN(Medium) m, Real h, Real mu, Real muS, Real nu) {
  Real r = radiusAt(m, h);
  Real a = (REAL(1.0) - nu) * (REAL(1.0) + nu);
  Real b = r * (mu - muS * nu);
  Real c = rhoSquared(m, h) - r * r * muS * muS;
  Real discriminant = b * b - a * c;
  // Both roots without cancelling: q / a and c / q.
  Real root = sqrt(max(discriminant, REAL(0.0)));
  Real q = b > REAL(0.0) ? -b - root : -b + root;
  Real t1 = a > REAL(1e-12) ? q / a : REAL(0.0);
  Real t2 = abs(q) > REAL(0.0) ? c / q : REAL(0.0);
  bool meets = discriminant > REAL(0.0);
  t1 = meets && r * muS + t1 * nu < REAL(0.0) ? t1 : REAL(0.0);
  t2 = meets && r * muS + t2 * nu < REAL(0.0) ? t2 : REAL(0.0);
  return Real2(max(t1, REAL(0.0)), max(t2, REAL(0.0)));
}

// The height over which the atmosphere at h thins out by e.
ALPENGLOW_FN Real localScaleHeight(IN(Medium) m, Real h) {
  Spectrum rayleigh = rayleighExtinction(m, h);
  Spectrum mie = mieExtinction(m, h);
  Real sumR = rayleigh[0] + rayleigh[1] + rayleigh[2];
  Real sumM = mie[0] + mie[1] + mie[2];
  return (sumR + sumM + REAL(1e-30)) /
         ((sumR + REAL(1e-30)) / m.rayleighScaleHeight + sumM / m.mieScaleHeight);
}

// One smooth segment of a ray, from t0 to t1: t = (q (b + D) - a) / (1 + q), q = a / (b + D) e^(u K), puts
// nodes of even u as far apart as a at its beginning and b at its end.
struct RaySegment {
  Real t0;
  Real span;    // D
  Real near_;   // a
  Real far_;    // b
  Real range;   // K
};

ALPENGLOW_FN RaySegment makeSegment(IN(Medium) m, IN(Ray) ray, Real t0, Real t1) {
  RaySegment p;
  p.t0 = t0;
  p.span = t1 - t0;
  Real h0 = altitudeAt(m, ray.h, ray.mu, t0);
  Real h1 = altitudeAt(m, ray.h, ray.mu, t1);
  Real mu0 = muAt(m, ray.h, ray.mu, t0, h0);
  Real mu1 = muAt(m, ray.h, ray.mu, t1, h1);
  Real low = min(h0, h1);
  Real rise = distanceToGain(m, low, h0 < h1 ? abs(mu0) : abs(mu1), localScaleHeight(m, low));
  Spectrum e = extinction(m, h0);
  Real free_ = REAL(1.0) / max(max(e[0], max(e[1], e[2])), REAL(1e-20));  // mean free path
  Real most = REAL(10.0) * p.span;
  p.near_ = max(min(min(free_, most), h0 <= h1 ? rise : most), REAL(1e-4) * p.span);
  p.far_ = max(min(h0 > h1 ? rise : most, most), REAL(1e-4) * p.span);
  p.range = log((p.near_ + p.span) / p.near_ * ((p.far_ + p.span) / p.far_));
  return p;
}

// Distance and dt/du at u in [0, 1] of a segment.
ALPENGLOW_FN Real2 segmentNode(IN(RaySegment) p, Real u) {
  Real end = p.far_ + p.span;
  Real q = p.near_ / end * exp(u * p.range);
  Real t = (q * end - p.near_) / (REAL(1.0) + q);
  Real slope = p.range / (REAL(1.0) / (p.near_ + t) + REAL(1.0) / (end - t));
  return Real2(p.t0 + t, slope);
}
