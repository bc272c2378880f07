// Reading the tables of the moment solver (field.glsl). The includer defines, before it includes this:
//   Spectrum readDepth(Real2 uv), readMoments(Real2 uv), readSource(Real3 uvw)   hardware-filtered fetches
// ALPENGLOW_WITHOUT_SOURCE makes the last unnecessary, ALPENGLOW_WITHOUT_MULTIPLE the last two.
// Everything is per unit solar irradiance.

// Optical depth from h to the top in a direction that rises.
ALPENGLOW_FN Spectrum depthOfRise(IN(Medium) m, IN(MomentShape) s, Real h, Real mu) {
  return decodeOpticalDepth(readDepth(depthCoordinate(m, s, h, mu))) *
         (distanceToTop(m, h, mu) / m.thickness);
}

// The exponent of equation 5 towards the top, in any direction that misses the ground; for one that hits it,
// that of the horizon's grazing ray. A ray that sinks is twice its rise from the perigee, less the part
// behind the point.
ALPENGLOW_FN Spectrum depthTowardsTop(IN(Medium) m, IN(MomentShape) s, Real h, Real mu) {
  Real drop = radiusAt(m, h) * mu * mu / (REAL(1.0) + sqrt(max(REAL(1.0) - mu * mu, REAL(0.0))));
  Real low = max(h - drop, REAL(0.0));
  Spectrum rise = depthOfRise(m, s, h, abs(mu));
  Spectrum grazing = depthOfRise(m, s, low, REAL(0.0));
  return mu < REAL(0.0) ? max(REAL(2.0) * grazing - rise, grazing) : rise;
}

// Equation 9 without Lsun: sunlight that arrives at h. The light of a soft sun whose centre is below the horizon
// comes from its upper edge, through the grazing ray's depth.
ALPENGLOW_FN Spectrum sunlight(IN(Medium) m, IN(MomentShape) s, Real h, Real muS) {
  return exp(-depthTowardsTop(m, s, h, max(muS, horizonMu(m, h)))) * sunVisibility(m, h, muS);
}

#ifdef ALPENGLOW_WITHOUT_MULTIPLE

ALPENGLOW_FN Spectrum fieldIrradiance(IN(Medium) m, IN(MomentShape) s, Real h, Real muS) {
  return SPECTRUM(REAL(0.0));
}

ALPENGLOW_FN Spectrum fieldSource(IN(Medium) m, IN(MomentShape) s, IN(SourceRay) ray, Real h, Real mu,
                                  Real muS) {
  return SPECTRUM(REAL(0.0));
}

#else

ALPENGLOW_FN Spectrum readLayer(IN(MomentShape) s, Real2 node, Real layer) {
  return readMoments(Real2(node[0], node[1] + layer / s.layers));
}

// E of the sky, equation 15, on a horizontal surface.
ALPENGLOW_FN Spectrum fieldIrradiance(IN(Medium) m, IN(MomentShape) s, Real h, Real muS) {
  return exp(readLayer(s, fieldCoordinate(s, nodeUv(m, s, h, muS)), REAL(4.0)));
}

// Rayleigh's part of J over N: its phase function is a quadratic form, so its integral is one of the second
// moments.
ALPENGLOW_FN Spectrum rayleighSource(IN(MomentShape) s, Real2 node, Real3 v) {
  Spectrum xx = readLayer(s, node, REAL(1.0));
  Spectrum zz = readLayer(s, node, REAL(2.0));
  Spectrum xz = readLayer(s, node, REAL(3.0));
  Spectrum one = SPECTRUM(REAL(1.0));
  return one + xx * (v[0] * v[0]) + (one - xx - zz) * (v[1] * v[1]) + zz * (v[2] * v[2]) +
         xz * (REAL(2.0) * v[0] * v[2]);
}

#ifndef ALPENGLOW_WITHOUT_SOURCE
// The aerosols' part of it, from the table of sources at node coordinates `uv`.
ALPENGLOW_FN Spectrum mieSource(IN(MomentShape) s, IN(SourceRay) ray, Real2 uv, Real mu, Real muS) {
  Real slice = sourceSlice(s, ray, mu, muS);
  Real lower = min(floor(slice), s.sourcePsi - REAL(2.0));
  Real3 at = Real3(ray.x + lower / s.sourcePsi, insetCoordinate(uv[0], s.nodesMuS),
                   insetCoordinate(uv[1], s.nodesR));
  Real3 step = Real3(REAL(1.0) / s.sourcePsi, REAL(0.0), REAL(0.0));
  return ray.shape * mix(readSource(at), readSource(at + step), slice - lower);
}
#endif

// J of equation 7 at a point of a ray.
ALPENGLOW_FN Spectrum fieldSource(IN(Medium) m, IN(MomentShape) s, IN(SourceRay) ray, Real h, Real mu,
                                  Real muS) {
  Real2 uv = nodeUv(m, s, h, muS);
  Real2 node = fieldCoordinate(s, uv);
  Spectrum sum = SPECTRUM(REAL(0.0));
  if (ALPENGLOW_RAYLEIGH)
    sum = m.rayleighScattering * (rayleighDensity(m, h) * REAL(0.75)) *
          rayleighSource(s, node, localDirection(mu, muS, ray.nu));
#ifndef ALPENGLOW_WITHOUT_SOURCE
  if (ALPENGLOW_MIE) sum += m.mieScattering * mieDensity(m, h) * mieSource(s, ray, uv, mu, muS);
#endif
  return exp(readLayer(s, node, REAL(0.0))) * sum;
}

#endif
