// Light that arrives along a ray, from the tables of the moment solver: needs ray_segment.glsl and
// field_lookup.glsl.

// What a segment of a ray sends to its beginning, per unit solar irradiance.
struct PathLight {
  Spectrum rayleigh;  // S[L0] by molecules, without phase function
  Spectrum mie;       // by aerosols
  Spectrum multiple;  // S[L - L0]
  Spectrum depth;     // optical depth of the segment
};

// One node's share; `transmittance` is that to the observer times dt.
ALPENGLOW_FN void addNode(IN(Medium) m, IN(MomentShape) s, IN(Ray) ray, IN(SourceRay) source, Real t,
                          Real h, Spectrum transmittance, bool single, bool multiple, OUT(Spectrum) rayleigh,
                          OUT(Spectrum) mie, OUT(Spectrum) scattered) {
  rayleigh = SPECTRUM(REAL(0.0));
  mie = SPECTRUM(REAL(0.0));
  scattered = SPECTRUM(REAL(0.0));
  Real muS = muSAt(m, ray.h, ray.muS, ray.nu, t, h);
  if (single) {
    Spectrum light = transmittance * sunlight(m, s, h, muS);
    if (ALPENGLOW_RAYLEIGH) rayleigh = light * rayleighDensity(m, h);
    if (ALPENGLOW_MIE) mie = light * mieDensity(m, h);
  }
  if (multiple)
    scattered = transmittance * fieldSource(m, s, source, h, muAt(m, ray.h, ray.mu, t, h), muS);
}

// A beam loses T(start) - T(end) in a panel, and no more than that can be scattered out of it. In a thick panel
// the sum over the two points, `quadrature`, may exceed that: the ratio limits their weights.
ALPENGLOW_FN Spectrum panelLimit(Spectrum start, Spectrum end, Spectrum depth, Spectrum quadrature) {
  Spectrum ratio = min((start - end) / max(quadrature, SPECTRUM(REAL(1e-30))), SPECTRUM(REAL(1.0)));
  // The difference is precise in thick panels only; in others the quadrature is exact.
  Spectrum thick = clamp(depth - SPECTRUM(REAL(2.0)), REAL(0.0), REAL(1.0));
  return mix(SPECTRUM(REAL(1.0)), ratio, thick);
}

// State of the sum along a ray: light up to distance t, without the scattering coefficients, which
// inscatteredLight applies.
struct InscatteringState {
  PathLight light;
  Spectrum transmittance;  // from the observer to t
  Real t;
  Real h;
};

ALPENGLOW_FN InscatteringState startInscattering(IN(Medium) m, IN(Ray) ray) {
  InscatteringState state;
  state.light.rayleigh = SPECTRUM(REAL(0.0));
  state.light.mie = SPECTRUM(REAL(0.0));
  state.light.multiple = SPECTRUM(REAL(0.0));
  state.light.depth = SPECTRUM(REAL(0.0));
  state.transmittance = SPECTRUM(REAL(1.0));
  state.t = REAL(0.0);
  state.h = min(ray.h, m.thickness);
  return state;
}

ALPENGLOW_FN PathLight inscatteredLight(IN(Medium) m, IN(InscatteringState) state) {
  PathLight light = state.light;
  light.rayleigh *= m.rayleighScattering;
  light.mie *= m.mieScattering;
  return light;
}

// Where the first Gauss point of a panel lies; the second is as far from its end.
ALPENGLOW_FN Real firstOfPanel() { return REAL(0.21132486540518712); }

// Optical depth of the tent along `d` metres between two altitudes.
ALPENGLOW_FN Spectrum tentBetween(IN(Medium) m, Real h0, Real h1, Real d) {
  Spectrum depth = SPECTRUM(REAL(0.0));
  if (ALPENGLOW_ABSORPTION) depth = m.absorptionExtinction * (meanAbsorptionDensity(m, h0, h1) * d);
  return depth;
}

// Adds a panel, up to distance `next`. nodeA and nodeB are its Gauss points: distance and dt of the panel.
ALPENGLOW_FN InscatteringState integratePanel(IN(Medium) m, IN(MomentShape) s, IN(Ray) ray, IN(SourceRay) source,
                                              IN(InscatteringState) before, Real2 nodeA, Real2 nodeB, Real next,
                                              bool single, bool multiple) {
  const Real kNear = REAL(0.25);  // depths of the two points by the rule's integration matrix
  const Real kCross = REAL(0.03867513459481288);
  InscatteringState state = before;
  Real hA = min(altitudeAt(m, ray.h, ray.mu, nodeA[0]), m.thickness);
  Real hB = min(altitudeAt(m, ray.h, ray.mu, nodeB[0]), m.thickness);
  state.t = next;
  state.h = min(altitudeAt(m, ray.h, ray.mu, next), m.thickness);
  Spectrum extinctionA = exponentialExtinction(m, hA) * nodeA[1];
  Spectrum extinctionB = exponentialExtinction(m, hB) * nodeB[1];
  // Optical depth of the tent up to either node and to the next panel.
  Spectrum tentA = tentBetween(m, before.h, hA, nodeA[0] - before.t);
  Spectrum tentB = tentA + tentBetween(m, hA, hB, nodeB[0] - nodeA[0]);
  Spectrum tent = tentB + tentBetween(m, hB, state.h, next - nodeB[0]);
  Spectrum depthA = max(before.light.depth + kNear * extinctionA - kCross * extinctionB,
                        before.light.depth) +
                    tentA;
  Spectrum depthB = before.light.depth + (REAL(0.5) + kCross) * extinctionA + kNear * extinctionB +
                    tentB;
  Spectrum depth = REAL(0.5) * (extinctionA + extinctionB) + tent;
  state.light.depth = before.light.depth + depth;
  Spectrum transmittanceA = exp(-depthA);
  Spectrum transmittanceB = exp(-depthB);
  state.transmittance = exp(-state.light.depth);
  Spectrum loss = transmittanceA * extinctionA + transmittanceB * extinctionB +
                  (transmittanceA + transmittanceB) * tent;
  Spectrum weight = REAL(0.5) * panelLimit(before.transmittance, state.transmittance, depth, REAL(0.5) * loss);
  Spectrum rayleighA, mieA, multipleA, rayleighB, mieB, multipleB;
  addNode(m, s, ray, source, nodeA[0], hA, transmittanceA * weight * nodeA[1], single, multiple, rayleighA, mieA,
          multipleA);
  addNode(m, s, ray, source, nodeB[0], hB, transmittanceB * weight * nodeB[1], single, multiple, rayleighB, mieB,
          multipleB);
  if (single && ALPENGLOW_RAYLEIGH) state.light.rayleigh += rayleighA + rayleighB;
  if (single && ALPENGLOW_MIE) state.light.mie += mieA + mieB;
  if (multiple) state.light.multiple += multipleA + multipleB;
  return state;
}

// Distances at which the first d metres of a ray are cut, in order; 0 or d where there is nothing to cut.
// Without single scattering only at the lowest point: its sources are smooth across the shadow's edge.
ALPENGLOW_FN Real3 pathCuts(IN(Medium) m, IN(Ray) ray, Real d, bool single) {
  Real lowest = -radiusAt(m, ray.h) * ray.mu;
  Real2 edges = shadowEdges(m, ray.h, ray.mu, ray.muS, ray.nu);
  if (!single) edges = Real2(REAL(0.0), REAL(0.0));
  Real c1 = clamp(min(edges[0], edges[1]), REAL(0.0), d);
  Real c2 = clamp(max(edges[0], edges[1]), REAL(0.0), d);
  Real c3 = clamp(lowest, REAL(0.0), d);
  return Real3(min(c1, c3), max(c1, min(c2, c3)), max(c2, c3));
}

// The first cut after t, or `end`.
ALPENGLOW_FN Real cutAfter(Real3 cuts, Real t, Real end) {
  return t < cuts[0] ? cuts[0] : t < cuts[1] ? cuts[1] : t < cuts[2] ? cuts[2] : end;
}

// Equation 11 over the first d metres of a ray: one event (`single`) and all orders that have been solved
// (`multiple`), both literals; `panels`: of two points, for each smooth segment.
ALPENGLOW_FN PathLight integrateInscattering(IN(Medium) m, IN(MomentShape) s, IN(Ray) ray, Real d, int panels,
                                             bool single, bool multiple) {
  Real3 cuts = pathCuts(m, ray, d, single);
  SourceRay source = makeSourceRay(s, ray.nu);
  InscatteringState state = startInscattering(m, ray);
  Real start = REAL(0.0);
  Real du = REAL(1.0) / Real(panels);
  for (int segment = 0; segment < 4; ++segment) {
    if (start >= d) break;
    Real end = cutAfter(cuts, start, d);
    RaySegment p = makeSegment(m, ray, start, end);
    state.t = start;
    state.h = min(altitudeAt(m, ray.h, ray.mu, start), m.thickness);
    for (int i = 0; i < panels; ++i) {
      Real2 nodeA = segmentNode(p, (Real(i) + firstOfPanel()) * du);
      Real2 nodeB = segmentNode(p, (Real(i) + REAL(1.0) - firstOfPanel()) * du);
      state = integratePanel(m, s, ray, source, state, Real2(nodeA[0], nodeA[1] * du),
                             Real2(nodeB[0], nodeB[1] * du), segmentNode(p, Real(i + 1) * du)[0], single,
                             multiple);
    }
    start = end;
  }
  return inscatteredLight(m, state);
}

// All the light that a path scatters to its beginning.
ALPENGLOW_FN Spectrum radianceOfPath(IN(Medium) m, IN(PathLight) light, Real nu) {
  Spectrum single = SPECTRUM(REAL(0.0));
  if (ALPENGLOW_RAYLEIGH) single = light.rayleigh * rayleighPhase(nu);
  if (ALPENGLOW_MIE) single += light.mie * miePhase(m.mieAsymmetry, nu);
  return single + light.multiple;
}
