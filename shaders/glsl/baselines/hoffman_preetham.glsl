// Hoffman & Preetham 2002, "Rendering Outdoor Light Scattering in Real Time": a medium of constant
// density, one event, in closed form. It has neither altitude nor space: the coefficients are those at the ground,
// wherever the camera is.

// Relative optical length of the atmosphere at a zenith angle: m = 1 / (cos t + 0.15 (93.885 - t)^-1.253), t in
// degrees, at most 90. Below the horizon the model is undefined; it answers as at the horizon.
ALPENGLOW_FN Real opticalMass(Real cosine) {
  Real c = clamp(cosine, REAL(0.0), REAL(1.0));
  Real degrees_ = arcCosine(c) * (REAL(180.0) / REAL(ALPENGLOW_PI));
  return REAL(1.0) / (c + REAL(0.15) * pow(REAL(93.885) - degrees_, REAL(-1.253)));
}

// Metres of constant density that hold as much as the atmosphere above the ground.
ALPENGLOW_FN Real rayleighLength() { return REAL(8400.0); }
ALPENGLOW_FN Real mieLength() { return REAL(1250.0); }

// Optical depth through all of the atmosphere.
ALPENGLOW_FN Spectrum depthThroughAtmosphere(IN(Medium) m, Real cosine) {
  return (m.rayleighScattering * rayleighLength() + m.mieExtinction * mieLength()) *
         opticalMass(cosine);
}

// Phi_HG, Henyey-Greenstein.
ALPENGLOW_FN Real henyeyGreenstein(Real g, Real nu) {
  Real d = (REAL(1.0) - abs(g)) * (REAL(1.0) - abs(g)) +
           REAL(2.0) * abs(g) * (REAL(1.0) - sign(g) * clamp(nu, REAL(-1.0), REAL(1.0)));
  return REAL(0.25) / REAL(ALPENGLOW_PI) * (REAL(1.0) - abs(g)) * (REAL(1.0) + abs(g)) /
         (d * sqrt(d));
}

// L_in = (beta_R Phi_R + beta_M Phi_M) / (beta_R + beta_M) E_sun (1 - exp(-(beta_R + beta_M) s)), with a length
// for each species, which the paper has for the sun's light. E_sun is dimmed by all of the atmosphere towards
// the sun.
ALPENGLOW_FN BaselineLight hoffmanPreethamLight(IN(Medium) m, Real muS, Real nu, Real lengthR,
                                                Real lengthM) {
  Spectrum scattered = m.rayleighScattering * (lengthR * rayleighPhase(nu)) +
                       m.mieScattering * (lengthM * henyeyGreenstein(m.mieAsymmetry, nu));
  BaselineLight result;
  result.depth = m.rayleighScattering * lengthR + m.mieExtinction * lengthM;
  result.light = scattered * exp(-depthThroughAtmosphere(m, muS)) * lightLetOut(result.depth);
  return result;
}

// Of the first d metres of a ray: all of the atmosphere where it ends in space, else d.
ALPENGLOW_FN BaselineLight hoffmanPreethamOfRay(IN(Medium) m, IN(Ray) ray, Real d) {
  bool toSpace = !ray.hitsGround && d >= ray.extent;
  Real mass = opticalMass(ray.mu);
  return hoffmanPreethamLight(m, ray.muS, ray.nu, toSpace ? rayleighLength() * mass : d,
                              toSpace ? mieLength() * mass : d);
}
