// Hillaire 2020, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique". The includer
// defines, besides what lookup.glsl asks for, where ALPENGLOW_MULTIPLE_READS is defined:
//   Spectrum readMultiple(Real2 uv)   Psi_ms

// --- The table of multiple scattering: x = (1 + mu_s) / 2, y = h / thickness (section 5.5).

ALPENGLOW_FN Real2 multipleCoordinate(IN(Medium) m, Real h, Real muS) {
  Real n = REAL(32.0);
  return Real2(insetCoordinate(clamp(REAL(0.5) + REAL(0.5) * muS, REAL(0.0), REAL(1.0)), n),
               insetCoordinate(clamp(h / m.thickness, REAL(0.0), REAL(1.0)), n));
}

// h and mu_s of u in [0, 1]^2.
ALPENGLOW_FN Real2 multipleHMuS(IN(Medium) m, Real2 u) {
  return Real2(u[1] * m.thickness, REAL(2.0) * u[0] - REAL(1.0));
}

ALPENGLOW_FN Spectrum scatteringAt(IN(Medium) m, Real h) {
  return m.rayleighScattering * rayleighDensity(m, h) + m.mieScattering * mieDensity(m, h);
}

// Of one direction: L' (equation 6) and L_f (equation 8), by 20 steps of equal length, over each of which the
// source is constant and the transmittance is integrated.
struct SecondOrder {
  Spectrum light;   // L'
  Spectrum factor;  // L_f
};

ALPENGLOW_FN SecondOrder secondOrder(IN(Medium) m, IN(TableShape) shape, IN(Ray) ray) {
  Real dt = ray.extent / REAL(20.0);
  Spectrum transmittance = SPECTRUM(REAL(1.0));
  SecondOrder sum;
  sum.light = SPECTRUM(REAL(0.0));
  sum.factor = SPECTRUM(REAL(0.0));
  for (int i = 0; i < 20; ++i) {
    Real t = (Real(i) + REAL(0.5)) * dt;
    Real h = min(altitudeAt(m, ray.h, ray.mu, t), m.thickness);
    Spectrum depth = extinction(m, h) * dt;
    Spectrum scattered = transmittance * scatteringAt(m, h) * lightLetOut(depth) * dt;
    Real muS = muSAt(m, ray.h, ray.muS, ray.nu, t, h);
    sum.light += scattered * transmittanceToSun(m, shape, h, muS) * (REAL(0.25) / REAL(ALPENGLOW_PI));
    sum.factor += scattered;
    transmittance *= exp(-depth);
  }
  Real muSGround = muSAt(m, ray.h, ray.muS, ray.nu, ray.extent, REAL(0.0));
  Spectrum sun = transmittanceToSun(m, shape, REAL(0.0), muSGround) * max(muSGround, REAL(0.0));
  Spectrum ground = transmittance * reflectedRadiance(m.groundAlbedo, sun, SPECTRUM(REAL(0.0)));
  sum.light += ray.hitsGround ? ground : SPECTRUM(REAL(0.0));
  return sum;
}

// Psi_ms = L_2nd / (1 - f_ms), equations 5, 7, 9 and 10: means over 8 x 8 directions of equal solid angle.
ALPENGLOW_FN Spectrum multipleScattering(IN(Medium) m, IN(TableShape) shape, Real h, Real muS) {
  Real sineS = sqrt(max(REAL(1.0) - muS * muS, REAL(0.0)));
  Spectrum light = SPECTRUM(REAL(0.0));
  Spectrum factor = SPECTRUM(REAL(0.0));
  for (int i = 0; i < 64; ++i) {
    Real mu = REAL(1.0) - (Real(i / 8) + REAL(0.5)) * REAL(0.25);
    Real phi = (Real(i % 8) + REAL(0.5)) * (REAL(0.25) * REAL(ALPENGLOW_PI));
    Real sine = sqrt(REAL(1.0) - mu * mu);
    Ray ray = makeRay(m, h, mu, sine, muS, mu * muS + sine * sineS * cos(phi));
    SecondOrder one = secondOrder(m, shape, ray);
    light += one.light;
    factor += one.factor;
  }
  Spectrum most = SPECTRUM(REAL(0.999));  // 1: a medium that absorbs nothing and lets no light out
  return light / REAL(64.0) / (SPECTRUM(REAL(1.0)) - min(factor / REAL(64.0), most));
}

// --- The sky-view LUT: x = sine of half the azimuth from the sun, y in halves below and above the horizon, each
// by the square root of the angle from it (section 5.3).

ALPENGLOW_FN Real2 skyViewCoordinate(Real horizon, Real nadirAngle, Real sineHalf, bool hitsGround,
                                     Real columns, Real rows) {
  Real off = hitsGround ? horizon - nadirAngle : nadirAngle - horizon;
  Real whole = hitsGround ? horizon : REAL(ALPENGLOW_PI) - horizon;
  Real u = sqrt(clamp(off / max(whole, REAL(1e-6)), REAL(0.0), REAL(1.0)));
  Real last = REAL(0.5) * rows - REAL(1.0);
  Real y = (hitsGround ? REAL(0.0) : REAL(0.5) * rows) + u * last;
  return Real2(insetCoordinate(sineHalf, columns), (y + REAL(0.5)) / rows);
}

// The ray of texel (x, y); the row says on which side of the horizon it lies.
ALPENGLOW_FN Ray skyViewRay(IN(Medium) m, Real horizon, Real h, Real muS, Real2 texel, Real2 size) {
  Real half_ = REAL(0.5) * size[1];
  bool hitsGround = texel[1] < half_;
  Real u = texelToU(hitsGround ? texel[1] : texel[1] - half_, half_);
  Real angle = hitsGround ? horizon * (REAL(1.0) - u * u)
                          : horizon + (REAL(ALPENGLOW_PI) - horizon) * u * u;
  Real sineHalf = texelToU(texel[0], size[0]);
  Real mu = -cos(angle);
  Real sine = sin(angle);
  Real cosPhi = REAL(1.0) - REAL(2.0) * sineHalf * sineHalf;
  Real nu = clamp(mu * muS + sine * sqrt(max(REAL(1.0) - muS * muS, REAL(0.0))) * cosPhi,
                  REAL(-1.0), REAL(1.0));
  Ray ray = makeRay(m, h, mu, sine, muS, nu);
  ray.hitsGround = hitsGround;
  ray.extent = hitsGround ? distanceToGround(m, ray.h, ray.mu) : distanceToTop(m, ray.h, ray.mu);
  return ray;
}

#ifdef ALPENGLOW_MULTIPLE_READS

ALPENGLOW_FN Spectrum multipleFromTable(IN(Medium) m, Real h, Real muS) {
  return readMultiple(multipleCoordinate(m, h, muS));
}

// Equation 11: L = integral of T sigma_s (T_sun S p + Psi_ms) over the first d metres of a ray. The steps grow
// with the distance, as d (i / N)^2; over each the source is constant and the transmittance is integrated.
ALPENGLOW_FN BaselineLight hillaireLight(IN(Medium) m, IN(TableShape) shape, IN(Ray) ray, Real d,
                                         Real stepCount) {
  Real phaseR = rayleighPhase(ray.nu);
  Real phaseM = miePhase(m.mieAsymmetry, ray.nu);
  Real from = REAL(0.0);
  BaselineLight sum;
  sum.light = SPECTRUM(REAL(0.0));
  sum.depth = SPECTRUM(REAL(0.0));
  for (int i = 0; i < int(stepCount); ++i) {
    Real end = Real(i + 1) / stepCount;
    Real to = d * end * end;
    Real t = REAL(0.5) * (from + to);
    Real h = min(altitudeAt(m, ray.h, ray.mu, t), m.thickness);
    Real muS = muSAt(m, ray.h, ray.muS, ray.nu, t, h);
    Spectrum rayleigh = m.rayleighScattering * rayleighDensity(m, h);
    Spectrum mie = m.mieScattering * mieDensity(m, h);
    Spectrum source = transmittanceToSun(m, shape, h, muS) * (rayleigh * phaseR + mie * phaseM) +
                      multipleFromTable(m, h, muS) * (rayleigh + mie);
    Spectrum depth = extinction(m, h) * (to - from);
    sum.light += exp(-sum.depth) * source * lightLetOut(depth) * (to - from);
    sum.depth += depth;
    from = to;
  }
  return sum;
}

#endif  // ALPENGLOW_MULTIPLE_READS
