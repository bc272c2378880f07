// Reading the tables. The includer defines, before it includes this:
//   Spectrum readTransmittance(Real2 uv), Spectrum readIrradiance(Real2 uv),
//   Real4 readScattering(Real3 uvw), Spectrum readSingleMie(Real3 uvw)   hardware-filtered fetches
// Everything is per unit solar irradiance.

// Number of texels in each dimension.
struct TableShape {
  Real transmittanceMu, transmittanceR, irradianceMuS, irradianceR;
  Real scatteringR, scatteringMu, scatteringMuS, scatteringNu;
};

ALPENGLOW_FN Real2 opticalDepthCoordinate(IN(Medium) m, IN(TableShape) shape, Real h, Real mu) {
  Real2 u = transmittanceUv(m, h, mu);
  return Real2(insetCoordinate(u[0], shape.transmittanceMu),
               insetCoordinate(u[1], shape.transmittanceR));
}

ALPENGLOW_FN Real2 irradianceCoordinate(IN(Medium) m, IN(TableShape) shape, Real h, Real muS) {
  Real2 u = irradianceUv(m, h, muS);
  return Real2(insetCoordinate(u[0], shape.irradianceMuS),
               insetCoordinate(u[1], shape.irradianceR));
}

// S is four-dimensional: a 3D texture holds its nu slices side by side along mu_s. This is the texture
// coordinate in the slice of nu = -1; nuSlice has the way from there.
ALPENGLOW_FN Real3 scatteringCoordinate(IN(Medium) m, IN(TableShape) shape, Real h, Real mu,
                                        Real muS, bool hitsGround) {
  Real uMuS = insetCoordinate(scatteringUmuS(muS), shape.scatteringMuS);
  Real uMu = scatteringUmu(m, h, mu, hitsGround);
  return Real3(uMuS / shape.scatteringNu,
               scatteringCoordinateMu(uMu, hitsGround, shape.scatteringMu),
               insetCoordinate(scatteringUr(m, h), shape.scatteringR));
}

// Offset in x to the slice below nu, and the share of the slice above it, whose offset is 1 / nu more.
ALPENGLOW_FN Real2 nuSlice(IN(TableShape) shape, Real nu) {
  Real slice = scatteringUnu(nu) * (shape.scatteringNu - REAL(1.0));
  Real lower = min(floor(slice), shape.scatteringNu - REAL(2.0));
  return Real2(lower / shape.scatteringNu, slice - lower);
}

#ifdef ALPENGLOW_TABLE_READS

// Optical depth towards the top, from the table, whatever is in the way.
ALPENGLOW_FN Spectrum opticalDepthFromTable(IN(Medium) m, IN(TableShape) shape, Real h, Real mu) {
  return decodeOpticalDepth(readTransmittance(opticalDepthCoordinate(m, shape, h, mu)));
}

// Equation 5 from the table, towards the top, whatever is in the way.
ALPENGLOW_FN Spectrum transmittanceToTop(IN(Medium) m, IN(TableShape) shape, Real h, Real mu) {
  return exp(-opticalDepthFromTable(m, shape, h, mu));
}

// Equation 9 without Lsun: sunlight that arrives at h.
ALPENGLOW_FN Spectrum transmittanceToSun(IN(Medium) m, IN(TableShape) shape, Real h, Real muS) {
  return transmittanceToTop(m, shape, h, muS) * sunVisibility(m, h, muS);
}

#ifdef ALPENGLOW_FINAL_READS

// E of the sky, equation 15, on a horizontal surface.
ALPENGLOW_FN Spectrum skyIrradiance(IN(Medium) m, IN(TableShape) shape, Real h, Real muS) {
  return readIrradiance(irradianceCoordinate(m, shape, h, muS));
}

// The rule of section 4 of the paper for single Mie scattering of which only the first channel is
// stored: C_M ~ C_* (C_M,r / C_*,r) (beta_R,r / beta_M,r) (beta_M / beta_R). Without Rayleigh scattering
// there is no C_* to take the colour from, and beta_M has it.
ALPENGLOW_FN Spectrum unpackSingleMie(IN(Medium) m, Real4 packed_) {
  Spectrum rayleigh = Spectrum(packed_[0], packed_[1], packed_[2]);
  Spectrum ratio = m.mieScattering / max(m.rayleighScattering, SPECTRUM(REAL(1e-30)));
  Spectrum c = rayleigh * (packed_[3] / max(packed_[0], REAL(1e-30)));
  Spectrum plain = m.mieScattering * (packed_[3] / max(m.mieScattering[0], REAL(1e-30)));
  return packed_[0] > REAL(0.0) && m.rayleighScattering[0] > REAL(0.0)
             ? c * (ratio / max(ratio[0], REAL(1e-30)))
             : plain;
}

// C_* P_R + C_M P_M, from what the tables hold for a ray; `mie` counts where C_M is stored in full.
ALPENGLOW_FN Spectrum scatteringFromTexels(IN(Medium) m, Real4 c, Spectrum mie, Real nu) {
  Spectrum single = ALPENGLOW_MIE_PACKED ? unpackSingleMie(m, c) : mie;
  return Spectrum(c[0], c[1], c[2]) * rayleighPhase(nu) + single * miePhase(m.mieAsymmetry, nu);
}

// S[L] of a whole ray, equation 11.
ALPENGLOW_FN Spectrum scatteringOfRay(IN(Medium) m, IN(TableShape) shape, Real h, Real mu, Real muS,
                                      Real nu, bool hitsGround) {
  Real2 slice = nuSlice(shape, nu);
  Real3 lower = scatteringCoordinate(m, shape, h, mu, muS, hitsGround) +
                Real3(slice[0], REAL(0.0), REAL(0.0));
  Real3 upper = lower + Real3(REAL(1.0) / shape.scatteringNu, REAL(0.0), REAL(0.0));
  Real4 c = mix(readScattering(lower), readScattering(upper), slice[1]);
  Spectrum mie = SPECTRUM(REAL(0.0));
  if (!ALPENGLOW_MIE_PACKED) mie = mix(readSingleMie(lower), readSingleMie(upper), slice[1]);
  return scatteringFromTexels(m, c, mie, nu);
}

#ifdef ALPENGLOW_SKY_VIEW_READS

// The same for the rays of one point under one sun, from the LUT of S at its r and mu_s: x = nu, y = mu,
// the includer's readSkyView and readSkyViewMie. Interpolation commutes: it is the same number, of two fetches
// in two dimensions instead of four in three.
ALPENGLOW_FN Spectrum scatteringOfRayInSkyView(IN(Medium) m, IN(TableShape) shape, Real h, Real mu,
                                               Real nu, bool hitsGround) {
  Real2 at = Real2(insetCoordinate(scatteringUnu(nu), shape.scatteringNu),
                   scatteringCoordinateMu(scatteringUmu(m, h, mu, hitsGround), hitsGround,
                                          shape.scatteringMu));
  Spectrum mie = SPECTRUM(REAL(0.0));
  if (!ALPENGLOW_MIE_PACKED) mie = readSkyViewMie(at);
  return scatteringFromTexels(m, readSkyView(at), mie, nu);
}

#endif  // ALPENGLOW_SKY_VIEW_READS

// S|x - T(x, xs) S|xs, equation 13: light scattered in the first d metres of a ray. One decision about
// the horizon is used for both ends. Where d reaches the end of the ray, S|xs is zero.
ALPENGLOW_FN Spectrum scatteringOfSegment(IN(Medium) m, IN(TableShape) shape, IN(Ray) ray, Real d,
                                          Spectrum transmittance) {
  Spectrum all = scatteringOfRay(m, shape, ray.h, ray.mu, ray.muS, ray.nu, ray.hitsGround);
  Real hs = min(altitudeAt(m, ray.h, ray.mu, d), m.thickness);
  Spectrum rest =
      scatteringOfRay(m, shape, hs, muAt(m, ray.h, ray.mu, d, hs),
                      muSAt(m, ray.h, ray.muS, ray.nu, d, hs), ray.nu, ray.hitsGround);
  Spectrum part = max(all - transmittance * rest, SPECTRUM(REAL(0.0)));
  return d < ray.extent ? part : all;
}

#endif  // ALPENGLOW_FINAL_READS
#endif  // ALPENGLOW_TABLE_READS
