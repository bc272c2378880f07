// Optical depth along rays, equation 5 of the paper before the exponential: the integral of the
// extinction over an arbitrary profile. Everything that needs it comes through this file.

// Equation 5 towards the top as the standard solver tabulates it, by trapezoids of equal length; on
// through the ground where that is in the way.
ALPENGLOW_FN Spectrum opticalDepthThroughGround(IN(Medium) m, Real h, Real mu, int trapezoids) {
  Real dx = distanceToTop(m, h, mu) / Real(trapezoids);
  Spectrum sum = REAL(0.5) * extinction(m, h);
  for (int i = 1; i <= trapezoids; ++i) {
    Real weight = i == trapezoids ? REAL(0.5) : REAL(1.0);
    sum += weight * extinction(m, signedAltitudeAt(m, h, mu, Real(i) * dx));
  }
  return sum * dx;
}

// The same, but a direction below the horizon answers for the horizon. Who needs to know whether the
// ground is in the way asks sunVisibility or rayHitsGround.
ALPENGLOW_FN Spectrum opticalDepthToTop(IN(Medium) m, Real h, Real mu, int trapezoids) {
  return opticalDepthThroughGround(m, h, max(mu, horizonMu(m, h)), trapezoids);
}

// Node (in (0, 1)) and weight of the 12-point Gauss-Legendre rule on [0, 1].
ALPENGLOW_FN Real2 gaussLegendre12(int i) {
  int k = i < 6 ? i : 11 - i;
  Real x = k == 0   ? REAL(0.0092196828766403747)
           : k == 1 ? REAL(0.0479413718147625717)
           : k == 2 ? REAL(0.1150486629028476564)
           : k == 3 ? REAL(0.2063410228566912763)
           : k == 4 ? REAL(0.3160842505009099031)
                    : REAL(0.4373832957442655423);
  Real w = k == 0   ? REAL(0.0235876681932559136)
           : k == 1 ? REAL(0.0534696629976592155)
           : k == 2 ? REAL(0.0800391642716731131)
           : k == 3 ? REAL(0.1015837133615329609)
           : k == 4 ? REAL(0.1167462682691774044)
                    : REAL(0.1245735229067013893);
  return Real2(i < 6 ? x : REAL(1.0) - x, w);
}

// Optical depth from distance t0 to t1 of a ray along which the altitude rises or falls all the way.
// `points` is 12, or 0 for none: a loop that does not run is the only code that costs nothing where
// branches are never skipped.
ALPENGLOW_FN Spectrum opticalDepthOfPiece(IN(Medium) m, Real h, Real mu, Real t0, Real t1,
                                          int points) {
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int i = 0; i < points; ++i) {
    Real2 node = gaussLegendre12(i);
    sum += node[1] * extinction(m, altitudeAt(m, h, mu, t0 + node[0] * (t1 - t0)));
  }
  return sum * (t1 - t0);
}

// Optical depth of the first d metres of a ray, split at its perigee and each part once more.
// Integrated, not taken as a difference of tabulated values: 1 - T of a short segment keeps its
// digits (a difference of values read from the
// 256x64 table is 5 to 18 % off for 1 km near the ground).
ALPENGLOW_FN Spectrum opticalDepthOfSegment(IN(Medium) m, Real h, Real mu, Real d) {
  Real perigee = clamp(-radiusAt(m, h) * mu, REAL(0.0), d);
  Real middle0 = REAL(0.5) * perigee;
  Real middle1 = REAL(0.5) * (perigee + d);
  return opticalDepthOfPiece(m, h, mu, REAL(0.0), middle0, 12) +
         opticalDepthOfPiece(m, h, mu, middle0, perigee, 12) +
         opticalDepthOfPiece(m, h, mu, perigee, middle1, 12) +
         opticalDepthOfPiece(m, h, mu, middle1, d, 12);
}
