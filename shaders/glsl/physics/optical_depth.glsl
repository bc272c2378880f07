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

// The same of the 4-point rule.
ALPENGLOW_FN Real2 gaussLegendre4(int i) {
  bool outer = i == 0 || i == 3;
  Real x = outer ? REAL(0.0694318442029737124) : REAL(0.3300094782075718676);
  Real w = outer ? REAL(0.1739274225687269287) : REAL(0.3260725774312730713);
  return Real2(i < 2 ? x : REAL(1.0) - x, w);
}

// Optical depth of the exponentials (12 points), and of the tent between its bends (4 points: there it is
// nearly a polynomial), between distances t0 and t1 of a ray. `points` may be 0 for none: a loop that
// does not run is the only code that costs nothing where branches are never skipped.
ALPENGLOW_FN Spectrum exponentialDepth(IN(Medium) m, Real h, Real mu, Real t0, Real t1,
                                       int points) {
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int i = 0; i < points; ++i) {
    Real2 node = gaussLegendre12(i);
    sum += node[1] * exponentialExtinction(m, altitudeAt(m, h, mu, t0 + node[0] * (t1 - t0)));
  }
  return sum * abs(t1 - t0);
}

ALPENGLOW_FN Spectrum tentDepth(IN(Medium) m, Real h, Real mu, Real t0, Real t1, int points) {
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int i = 0; i < points; ++i) {
    Real2 node = gaussLegendre4(i);
    sum += node[1] * tentExtinction(m, altitudeAt(m, h, mu, t0 + node[0] * (t1 - t0)));
  }
  return sum * abs(t1 - t0);
}

// Distance in which a ray that rises from altitude h gains `gain` metres.
ALPENGLOW_FN Real distanceToGain(IN(Medium) m, Real h, Real mu, Real gain) {
  Real rMu = radiusAt(m, h) * mu;
  Real gain2 = gain * (REAL(2.0) * radiusAt(m, h) + gain);
  return gain2 / max(rMu + sqrt(rMu * rMu + gain2), REAL(1e-6));
}

// Optical depth of the tent on one side of a ray's lowest point, which lies at distance `lowest` and altitude
// `low`: from there `reach` metres on (direction 1) or back (-1), rising with zenith cosine `rise`.
ALPENGLOW_FN Spectrum tentDepthOfSide(IN(Medium) m, Real h, Real mu, Real lowest, Real low, Real rise,
                                      Real direction, Real reach, int points) {
  Real foot = max(m.absorptionCenter - m.absorptionHalfWidth - low, REAL(0.0));
  Real top = max(m.absorptionCenter - low, REAL(0.0));
  Real end = max(m.absorptionCenter + m.absorptionHalfWidth - low, REAL(0.0));
  Real b1 = min(distanceToGain(m, low, rise, foot), reach) * direction;
  Real b2 = min(distanceToGain(m, low, rise, top), reach) * direction;
  Real b3 = min(distanceToGain(m, low, rise, end), reach) * direction;
  return tentDepth(m, h, mu, lowest + b1, lowest + b2, points) +
         tentDepth(m, h, mu, lowest + b2, lowest + b3, points);
}

// Optical depth of everything on one side of a ray's lowest point, as above. Split where the ray has
// gained 3 and 12 of the smaller scale height and 12 of the larger, so that the nodes are where the atmosphere
// is, however high the shell; and at the tent's bends.
ALPENGLOW_FN Spectrum opticalDepthOfSide(IN(Medium) m, Real h, Real mu, Real lowest, Real direction,
                                         Real reach) {
  Real low = altitudeAt(m, h, mu, lowest);
  Real rise = abs(muAt(m, h, mu, lowest, low));
  Spectrum tent = SPECTRUM(REAL(0.0));
  if (ALPENGLOW_ABSORPTION) tent = tentDepthOfSide(m, h, mu, lowest, low, rise, direction, reach, 4);
  Real least = min(m.rayleighScaleHeight, m.mieScaleHeight);
  Real most = max(m.rayleighScaleHeight, m.mieScaleHeight);
  Real s1 = min(distanceToGain(m, low, rise, REAL(3.0) * least), reach) * direction;
  Real s2 = min(distanceToGain(m, low, rise, REAL(12.0) * least), reach) * direction;
  Real s3 = min(distanceToGain(m, low, rise, REAL(12.0) * most), reach) * direction;
  return exponentialDepth(m, h, mu, lowest, lowest + s1, 12) +
         exponentialDepth(m, h, mu, lowest + s1, lowest + s2, 12) +
         exponentialDepth(m, h, mu, lowest + s2, lowest + s3, 12) +
         exponentialDepth(m, h, mu, lowest + s3, lowest + reach * direction, 12) + tent;
}

// Optical depth of the first d metres of a ray, both sides of its lowest point. Integrated, not taken as
// a difference of tabulated values: 1 - T of a short segment keeps its digits.
ALPENGLOW_FN Spectrum opticalDepthOfSegment(IN(Medium) m, Real h, Real mu, Real d) {
  Real lowest = clamp(-radiusAt(m, h) * mu, REAL(0.0), d);
  return opticalDepthOfSide(m, h, mu, lowest, REAL(-1.0), lowest) +
         opticalDepthOfSide(m, h, mu, lowest, REAL(1.0), d - lowest);
}

// Optical depth of a ray that hits the ground at distance d, for a pixel: one rule for the exponentials,
// enough for a shell of some 50 scale heights. Nothing, at no cost, unless `any`.
ALPENGLOW_FN Spectrum opticalDepthToGround(IN(Medium) m, Real h, Real mu, Real d, bool any_) {
  Real rise = -muAt(m, h, mu, d, REAL(0.0));
  Spectrum depth = exponentialDepth(m, h, mu, REAL(0.0), d, any_ ? 12 : 0);
  if (ALPENGLOW_ABSORPTION)
    depth += tentDepthOfSide(m, h, mu, d, REAL(0.0), rise, REAL(-1.0), d, any_ ? 4 : 0);
  return depth;
}

// Tables hold the logarithm of its optical depth tau, as ln(1 + tau / unit): never negative,
// 0 where there is no air. Towards the horizon tau grows exponentially from texel to texel: with tau
// itself in the table, order 1 at the horizon from 10 km was 15 % off; with its logarithm, 5 %.
ALPENGLOW_FN Real opticalDepthUnit() { return REAL(1e-5); }

ALPENGLOW_FN Spectrum encodeOpticalDepth(Spectrum depth) {
  return log(SPECTRUM(REAL(1.0)) + depth / opticalDepthUnit());
}

ALPENGLOW_FN Spectrum decodeOpticalDepth(Spectrum stored) {
  return (exp(stored) - SPECTRUM(REAL(1.0))) * opticalDepthUnit();
}
