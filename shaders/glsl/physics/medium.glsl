// What the atmosphere is made of at an altitude h above the ground sphere (section 2 of the paper).

// Laid out as std140 has it, so that the C++ float version is the uniform block's bytes.
struct Medium {
  ALPENGLOW_STD140(Spectrum) rayleighScattering;  // beta_R at h = 0, 1/m
  Real rayleighScaleHeight;                       // H_R, m
  ALPENGLOW_STD140(Spectrum) mieScattering;       // beta_M at h = 0, 1/m
  Real mieScaleHeight;                            // H_M, m
  ALPENGLOW_STD140(Spectrum) mieExtinction;       // 1/m
  Real mieAsymmetry;                              // g
  ALPENGLOW_STD140(Spectrum) absorptionExtinction;  // at the tent's center, 1/m
  Real absorptionCenter;                          // m
  ALPENGLOW_STD140(Spectrum) groundAlbedo;
  Real absorptionHalfWidth;   // m
  Real bottomRadius;          // Rg, m
  Real thickness;             // Rt - Rg, m
  Real topRho;                // H = sqrt(Rt^2 - Rg^2), m
  Real transmittanceMuMin;    // least mu of the transmittance table
  Real sunSinRadius;          // sine of the sun's angular radius, 0 for a parallel beam
  Real unused0, unused1, unused2;
};

// Relative densities. Below the ground the exponentials go on for one scale height and stay there:
// a table of optical depths needs a smooth continuation across the horizon (standard.glsl).
ALPENGLOW_FN Real rayleighDensity(IN(Medium) m, Real h) {
  return exp(min(-h / m.rayleighScaleHeight, REAL(1.0)));
}

ALPENGLOW_FN Real mieDensity(IN(Medium) m, Real h) {
  return exp(min(-h / m.mieScaleHeight, REAL(1.0)));
}

ALPENGLOW_FN Real absorptionDensity(IN(Medium) m, Real h) {
  return max(REAL(0.0), REAL(1.0) - abs(h - m.absorptionCenter) / m.absorptionHalfWidth);
}

// The same averaged over the altitudes between two: so that a quadrature need not stop at its bends.
ALPENGLOW_FN Real absorptionColumn(IN(Medium) m, Real h) {
  Real x = clamp((h - m.absorptionCenter) / m.absorptionHalfWidth, REAL(-1.0), REAL(1.0));
  return m.absorptionHalfWidth * (REAL(0.5) + x - REAL(0.5) * x * abs(x));
}

ALPENGLOW_FN Real meanAbsorptionDensity(IN(Medium) m, Real h0, Real h1) {
  Real rise = h1 - h0;
  // Closer than this the difference has no digits left, and a bend between makes none either.
  bool close = abs(rise) < REAL(4e-3) * m.absorptionHalfWidth;
  Real slope = (absorptionColumn(m, h1) - absorptionColumn(m, h0)) / (close ? REAL(1.0) : rise);
  return close ? absorptionDensity(m, REAL(0.5) * (h0 + h1)) : slope;
}

// R[L], equation 10: light that a Lambertian ground sends up under these irradiances of a horizontal
// surface; equation 14 with n = n-bar.
ALPENGLOW_FN Spectrum reflectedRadiance(Spectrum albedo, Spectrum direct, Spectrum sky) {
  return albedo / REAL(ALPENGLOW_PI) * (direct + sky);
}

// Extinction of molecules and of aerosols, 1/m.
ALPENGLOW_FN Spectrum rayleighExtinction(IN(Medium) m, Real h) {
  Spectrum beta = SPECTRUM(REAL(0.0));
  if (ALPENGLOW_RAYLEIGH) beta = m.rayleighScattering * rayleighDensity(m, h);
  return beta;
}

ALPENGLOW_FN Spectrum mieExtinction(IN(Medium) m, Real h) {
  Spectrum beta = SPECTRUM(REAL(0.0));
  if (ALPENGLOW_MIE) beta = m.mieExtinction * mieDensity(m, h);
  return beta;
}

// Extinction of what thins out exponentially, and of the tent, 1/m. They are apart because they are
// smooth in different segments of a ray.
ALPENGLOW_FN Spectrum exponentialExtinction(IN(Medium) m, Real h) {
  return rayleighExtinction(m, h) + mieExtinction(m, h);
}

ALPENGLOW_FN Spectrum tentExtinction(IN(Medium) m, Real h) {
  Spectrum beta = SPECTRUM(REAL(0.0));
  if (ALPENGLOW_ABSORPTION) beta = m.absorptionExtinction * absorptionDensity(m, h);
  return beta;
}

// Extinction coefficient of everything at h, 1/m. The one place that knows the profiles: optical
// depths integrate it along rays (optical_depth.glsl).
ALPENGLOW_FN Spectrum extinction(IN(Medium) m, Real h) {
  return exponentialExtinction(m, h) + tentExtinction(m, h);
}
