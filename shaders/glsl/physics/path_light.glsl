// Light that arrives along a ray, from the tables of the moment solver: needs path.glsl and
// field_lookup.glsl.

// What a stretch of a ray sends to its beginning, per unit solar irradiance.
struct PathLight {
  Spectrum rayleigh;  // S[L0] by molecules, without phase function
  Spectrum mie;       // by aerosols
  Spectrum multiple;  // S[L - L0]
  Spectrum depth;     // its optical depth
};

// One node's share; `seen` is the transmittance to the observer times dt.
ALPENGLOW_FN void addNode(IN(Medium) m, IN(MomentShape) s, IN(Ray) ray, IN(SourceRay) source, Real t,
                          Real h, Spectrum seen, bool single, bool multiple, OUT(Spectrum) rayleigh,
                          OUT(Spectrum) mie, OUT(Spectrum) scattered) {
  rayleigh = SPECTRUM(REAL(0.0));
  mie = SPECTRUM(REAL(0.0));
  scattered = SPECTRUM(REAL(0.0));
  Real muS = muSAt(m, ray.h, ray.muS, ray.nu, t, h);
  if (single) {
    Spectrum light = seen * sunlight(m, s, h, muS);
    rayleigh = light * rayleighDensity(m, h);
    mie = light * mieDensity(m, h);
  }
  if (multiple)
    scattered = seen * fieldSource(m, s, source, h, muAt(m, ray.h, ray.mu, t, h), muS);
}

// A beam loses T(start) - T(end) in a panel, and no more than that can be scattered out of it. Where a panel
// is thick its two points may add up to more, `quadrature`: the ratio holds their weights to what there is.
ALPENGLOW_FN Spectrum panelLimit(Spectrum start, Spectrum end, Spectrum depth, Spectrum quadrature) {
  Spectrum ratio = min((start - end) / max(quadrature, SPECTRUM(REAL(1e-30))), SPECTRUM(REAL(1.0)));
  // The difference has digits enough in thick panels only; in others the points are exact.
  Spectrum thick = clamp(depth - SPECTRUM(REAL(2.0)), REAL(0.0), REAL(1.0));
  return mix(SPECTRUM(REAL(1.0)), ratio, thick);
}

// Equation 11 over the first d metres of a ray: one event (`single`), and all that have been solved
// (`multiple`), both literals; panels: of two points, for each piece.
ALPENGLOW_FN PathLight lightOfPath(IN(Medium) m, IN(MomentShape) s, IN(Ray) ray, Real d, int panels,
                                   bool single, bool multiple) {
  const Real kFirst = REAL(0.21132486540518712);  // Gauss points of a panel, and what lies
  const Real kNear = REAL(0.25);                   // before them of its integral
  const Real kCross = REAL(0.03867513459481288);
  PathLight light;
  light.rayleigh = SPECTRUM(REAL(0.0));
  light.mie = SPECTRUM(REAL(0.0));
  light.multiple = SPECTRUM(REAL(0.0));
  light.depth = SPECTRUM(REAL(0.0));
  Real lowest = -radiusAt(m, ray.h) * ray.mu;
  Real2 edges = shadowEdges(m, ray.h, ray.mu, ray.muS, ray.nu);
  if (!single) edges = Real2(REAL(0.0), REAL(0.0));  // sources are smooth across the shadow's edge
  Real c1 = clamp(min(edges[0], edges[1]), REAL(0.0), d);
  Real c2 = clamp(max(edges[0], edges[1]), REAL(0.0), d);
  Real c3 = clamp(lowest, REAL(0.0), d);
  Real b1 = min(c1, c3);
  Real b2 = max(c1, min(c2, c3));
  Real b3 = max(c2, c3);
  SourceRay source = makeSourceRay(s, ray.nu);
  Spectrum seen = SPECTRUM(REAL(1.0));
  Real start = REAL(0.0);
  Real du = REAL(1.0) / Real(panels);
  for (int piece = 0; piece < 4; ++piece) {
    if (start >= d) break;
    Real end = start < b1 ? b1 : start < b2 ? b2 : start < b3 ? b3 : d;
    Piece p = makePiece(m, ray, start, end);
    Real t = start;
    Real h = min(altitudeAt(m, ray.h, ray.mu, start), m.thickness);
    for (int i = 0; i < panels; ++i) {
      Real2 nodeA = pieceNode(p, (Real(i) + kFirst) * du);
      Real2 nodeB = pieceNode(p, (Real(i) + REAL(1.0) - kFirst) * du);
      Real next = pieceNode(p, Real(i + 1) * du)[0];
      Real hA = min(altitudeAt(m, ray.h, ray.mu, nodeA[0]), m.thickness);
      Real hB = min(altitudeAt(m, ray.h, ray.mu, nodeB[0]), m.thickness);
      Real hNext = min(altitudeAt(m, ray.h, ray.mu, next), m.thickness);
      Spectrum extinctionA = exponentialExtinction(m, hA) * (nodeA[1] * du);
      Spectrum extinctionB = exponentialExtinction(m, hB) * (nodeB[1] * du);
      // Metres of the tent's full density up to either node and to the next panel.
      Real tentA = meanAbsorptionDensity(m, h, hA) * (nodeA[0] - t);
      Real tentB = tentA + meanAbsorptionDensity(m, hA, hB) * (nodeB[0] - nodeA[0]);
      Real tent = tentB + meanAbsorptionDensity(m, hB, hNext) * (next - nodeB[0]);
      Spectrum depthA =
          max(light.depth + kNear * extinctionA - kCross * extinctionB, light.depth) +
          m.absorptionExtinction * tentA;
      Spectrum depthB = light.depth + (REAL(0.5) + kCross) * extinctionA + kNear * extinctionB +
                        m.absorptionExtinction * tentB;
      Spectrum depth =
          REAL(0.5) * (extinctionA + extinctionB) + m.absorptionExtinction * tent;
      light.depth += depth;
      Spectrum seenA = exp(-depthA);
      Spectrum seenB = exp(-depthB);
      Spectrum seenNext = exp(-light.depth);
      Spectrum loss = seenA * extinctionA + seenB * extinctionB +
                      (seenA + seenB) * m.absorptionExtinction * tent;
      Spectrum weight = REAL(0.5) * panelLimit(seen, seenNext, depth, REAL(0.5) * loss);
      t = next;
      h = hNext;
      seen = seenNext;
      Spectrum r, mi, mu;
      addNode(m, s, ray, source, nodeA[0], hA, seenA * weight * (nodeA[1] * du), single, multiple, r,
              mi, mu);
      light.rayleigh += r;
      light.mie += mi;
      light.multiple += mu;
      addNode(m, s, ray, source, nodeB[0], hB, seenB * weight * (nodeB[1] * du), single, multiple, r,
              mi, mu);
      light.rayleigh += r;
      light.mie += mi;
      light.multiple += mu;
    }
    start = end;
  }
  light.rayleigh *= m.rayleighScattering;
  light.mie *= m.mieScattering;
  return light;
}

// All the light that a path scatters to its beginning.
ALPENGLOW_FN Spectrum radianceOfPath(IN(Medium) m, IN(PathLight) light, Real nu) {
  return light.rayleigh * rayleighPhase(nu) + light.mie * miePhase(m.mieAsymmetry, nu) +
         light.multiple;
}
