// Schafhitzel, Falk & Ertl 2007, "Real-Time Rendering of Planets with Atmospheres": single scattering in a
// table over (r, mu, mu_s), Rayleigh and Mie apart and without phase functions. The includer defines, where
// ALPENGLOW_RAY_READS is defined:
//   Spectrum readScatteringRayleigh(Real3 uvw), readScatteringMie(uvw)

// The azimuth that the table leaves out is a right angle, the mean of all: nu = mu mu_s.
ALPENGLOW_FN Real tableNu(Real mu, Real muS) { return mu * muS; }

#ifdef ALPENGLOW_RAY_READS

// Light of a whole ray, with the phase functions of its true angle.
ALPENGLOW_FN Spectrum schafhitzelOfRay(IN(Medium) m, IN(TableShape) shape, Real h, Real mu, Real muS,
                                       Real nu, bool hitsGround) {
  Real3 at = scatteringCoordinate(m, shape, h, mu, muS, hitsGround);
  return readScatteringRayleigh(at) * rayleighPhase(nu) +
         readScatteringMie(at) * miePhase(m.mieAsymmetry, nu);
}

// S(x) - T(x, x0) S(x0): light of the first d metres of a ray.
ALPENGLOW_FN Spectrum schafhitzelOfSegment(IN(Medium) m, IN(TableShape) shape, IN(Ray) ray, Real d,
                                           Spectrum transmittance) {
  Spectrum all = schafhitzelOfRay(m, shape, ray.h, ray.mu, ray.muS, ray.nu, ray.hitsGround);
  Real hs = min(altitudeAt(m, ray.h, ray.mu, d), m.thickness);
  Spectrum rest =
      schafhitzelOfRay(m, shape, hs, muAt(m, ray.h, ray.mu, d, hs),
                       muSAt(m, ray.h, ray.muS, ray.nu, d, hs), ray.nu, ray.hitsGround);
  Spectrum part = max(all - transmittance * rest, SPECTRUM(REAL(0.0)));
  return d < ray.extent ? part : all;
}

#endif  // ALPENGLOW_RAY_READS
