// O'Neil 2005, "Accurate Atmospheric Scattering", GPU Gems 2, chapter 16: the in-scattering equation of single
// scattering (section 16.2.3) by the midpoint rule.

// I_v = I_s K F integral of exp(-h / H) exp(-t(P, sun) - t(P, eye)) over the first d metres of a ray, for both
// species: t(P, sun) from the table, t(P, eye) (the out-scattering equation, section 16.2.2) summed up at the
// same points, F the phase functions (section 16.2.1).
ALPENGLOW_FN BaselineLight oneilLight(IN(Medium) m, IN(TableShape) shape, IN(Ray) ray, Real d,
                                      Real stepCount) {
  Real dt = d / stepCount;
  Spectrum rayleigh = SPECTRUM(REAL(0.0));
  Spectrum mie = SPECTRUM(REAL(0.0));
  BaselineLight sum;
  sum.depth = SPECTRUM(REAL(0.0));
  for (int i = 0; i < int(stepCount); ++i) {
    Real t = (Real(i) + REAL(0.5)) * dt;
    Real h = min(altitudeAt(m, ray.h, ray.mu, t), m.thickness);
    Spectrum halfDepth = extinction(m, h) * (REAL(0.5) * dt);
    Real muS = muSAt(m, ray.h, ray.muS, ray.nu, t, h);
    Spectrum light = exp(-(sum.depth + halfDepth)) * transmittanceToSun(m, shape, h, muS);
    rayleigh += light * rayleighDensity(m, h);
    mie += light * mieDensity(m, h);
    sum.depth += REAL(2.0) * halfDepth;
  }
  sum.light = (rayleigh * m.rayleighScattering * rayleighPhase(ray.nu) +
               mie * m.mieScattering * miePhase(m.mieAsymmetry, ray.nu)) * dt;
  return sum;
}
