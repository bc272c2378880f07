// The moment solver: what one texel of each of its tables holds. The angular integral of equation 7 is a
// convolution, so it is diagonal in spherical harmonics: light that arrives at a node is integrated along
// rays (L), taken apart into azimuthal modes (F) and harmonics (M), turned into the sun's frame (R),
// multiplied with the coefficients of the aerosols' phase function, and put together again as the source of
// the next order (H, J). What molecules scatter needs second moments only (N), which the next order reads from
// a finer table (I). The includer defines, besides the reads of field_lookup.glsl:
//   Spectrum fetchRadiance(int x, int y), fetchRadianceMie(...), fetchRadianceGround(...)   pass F
//   Spectrum fetchModes(int x, int y), fetchMoments(int x, int y), fetchSourceModes(int x, int y)
//   Spectrum fetchNode(int x, int y)                                                        pass I
//   Real2 fetchRule(int x, int y); Real fetchLegendre(int x, int y), fetchRotation(int x, int y)
// A node's index is i_mus + nodesMuS * i_r.

// Single scattering is bright around the sun: order 1 takes twice the zenith angles, and its phase functions at
// kFineAzimuths times the azimuths.
const int kFineZeniths = 2;
const int kFineAzimuths = 4;

struct NodePoint {
  Real h;
  Real muS;
  int r;  // index of its altitude
};

ALPENGLOW_FN NodePoint nodePoint(IN(Medium) m, IN(MomentShape) s, int node) {
  NodePoint p;
  int sizeMuS = int(s.nodesMuS);
  p.r = node / sizeMuS;
  p.h = nodeH(m, s, texelToU(Real(p.r), s.nodesR));
  p.muS = nodeMuS(s, texelToU(Real(node - p.r * sizeMuS), s.nodesMuS));
  return p;
}

// --- Pass T: optical depth towards the top.

ALPENGLOW_FN Spectrum depthOfTexel(IN(Medium) m, IN(MomentShape) s, int x, int y) {
  return depthAtUv(
      m, s, Real2(texelToU(Real(x), s.depthMu), texelToU(Real(y), s.depthH)));
}

// --- Pass Q: quadrature in zenith angle.

// Node and weight i of the n-point Gauss-Legendre rule on [0, 1], by Newton's method.
ALPENGLOW_FN Real2 gaussLegendre(int i, int n) {
  Real x = cos(REAL(ALPENGLOW_PI) * (Real(i) + REAL(0.75)) / (Real(n) + REAL(0.5)));
  Real slope = REAL(1.0);
  for (int iteration = 0; iteration < 6; ++iteration) {
    Real p0 = REAL(1.0);
    Real p1 = x;
    for (int k = 2; k <= n; ++k) {
      Real p2 = (Real(2 * k - 1) * x * p1 - Real(k - 1) * p0) / Real(k);
      p0 = p1;
      p1 = p2;
    }
    slope = Real(n) * (x * p1 - p0) / (x * x - REAL(1.0));
    x -= p1 / slope;
  }
  Real weight = REAL(1.0) / ((REAL(1.0) - x * x) * slope * slope);
  return Real2(REAL(0.5) - REAL(0.5) * x, weight);
}

ALPENGLOW_FN int zenithCount(IN(MomentShape) s, int fine) {
  return (int(s.zenithsSky) + int(s.zenithsLimb) + int(s.zenithsGround)) * fine;
}

// Texel (zenith, row) of the table of rules: row 0 with the zenith angles, row 1 with those of order 1.
ALPENGLOW_FN Real2 zenithRule(IN(MomentShape) s, int zenith, int row) {
  int fine = row == 0 ? 1 : kFineZeniths;
  int sky = int(s.zenithsSky) * fine;
  int limb = int(s.zenithsLimb) * fine;
  int ground = int(s.zenithsGround) * fine;
  if (zenith < sky) return gaussLegendre(zenith, sky);
  if (zenith < sky + limb) return gaussLegendre(zenith - sky, limb);
  return gaussLegendre(min(zenith - sky - limb, ground - 1), ground);
}

// A cone of directions of incoming light.
struct ZenithAngle {
  Real mu;
  Real weight;  // of its mu
  bool hitsGround;
  bool rises;
};

// Three bands, each dense towards the horizon or the horizontal, where the light changes most: the sky
// above the horizontal (whose light is irradiance), down to the horizon, and the ground.
ALPENGLOW_FN ZenithAngle makeZenithAngle(IN(Medium) m, IN(MomentShape) s, Real h, int zenith, int fine, Real2 rule) {
  ZenithAngle result;
  int sky = int(s.zenithsSky) * fine;
  int limb = int(s.zenithsLimb) * fine;
  Real horizon = horizonMu(m, h);
  Real y2 = rule[0] * rule[0];
  result.rises = zenith < sky;
  result.hitsGround = zenith >= sky + limb;
  result.mu = result.rises        ? y2
              : result.hitsGround ? horizon - (REAL(1.0) + horizon) * y2
                                  : horizon * (REAL(1.0) - y2);
  result.weight = REAL(2.0) * rule[0] * rule[1] *
                  (result.rises ? REAL(1.0) : result.hitsGround ? REAL(1.0) + horizon : -horizon);
  return result;
}

// --- Pass L: light that arrives at a node along the rays of a zenith angle. x = azimuth + azimuths * zenith.

ALPENGLOW_FN Ray nodeRay(IN(Medium) m, IN(NodePoint) p, IN(ZenithAngle) zenith, Real azimuth) {
  Ray ray;
  ray.start = REAL(0.0);
  ray.h = p.h;
  ray.mu = zenith.mu;
  ray.muS = p.muS;
  Real spread = sqrt(max((REAL(1.0) - zenith.mu * zenith.mu) * (REAL(1.0) - p.muS * p.muS), REAL(0.0)));
  ray.nu = clamp(zenith.mu * p.muS + spread * cos(azimuth), REAL(-1.0), REAL(1.0));
  ray.hitsGround = zenith.hitsGround;
  ray.extent = zenith.hitsGround ? distanceToGround(m, p.h, zenith.mu) : distanceToTop(m, p.h, zenith.mu);
  ray.inAtmosphere = true;
  return ray;
}

ALPENGLOW_FN Ray rayOfTexel(IN(Medium) m, IN(MomentShape) s, int x, int node, int fine) {
  NodePoint p = nodePoint(m, s, node);
  int azimuths = int(s.azimuths);
  int index = x / azimuths;
  ZenithAngle zenith = makeZenithAngle(m, s, p.h, index, fine, fetchRule(index, fine == 1 ? 0 : 1));
  return nodeRay(m, p, zenith, (Real(x - index * azimuths) + REAL(0.5)) * REAL(ALPENGLOW_PI) /
                                 s.azimuths);
}

// Zenith cosine of the sun where a ray meets the ground.
ALPENGLOW_FN Real muSAtGround(IN(Medium) m, IN(Ray) ray) {
  return muSAt(m, ray.h, ray.muS, ray.nu, ray.extent, REAL(0.0));
}

// Order 1: S[L0] without phase functions, and R[L0] through the atmosphere.
ALPENGLOW_FN void singleLight(IN(Medium) m, IN(MomentShape) s, int x, int node,
                              OUT(Spectrum) rayleigh, OUT(Spectrum) mie, OUT(Spectrum) ground) {
  Ray ray = rayOfTexel(m, s, x, node, kFineZeniths);
  PathLight light = integrateInscattering(m, s, ray, ray.extent, int(s.solverPanels), true, false);
  rayleigh = light.rayleigh;
  mie = light.mie;
  Real muS = muSAtGround(m, ray);
  ground = SPECTRUM(REAL(0.0));
  if (ALPENGLOW_GROUND_REFLECTION) {
    Spectrum up = m.groundAlbedo / REAL(ALPENGLOW_PI) * exp(-light.depth) *
                  sunlight(m, s, REAL(0.0), muS) * max(muS, REAL(0.0));
    ground = ray.hitsGround ? up : ground;
  }
}

// Order n >= 2: S[L] of the order before from its source, and R[L] of its irradiance.
ALPENGLOW_FN Spectrum multipleLight(IN(Medium) m, IN(MomentShape) s, int x, int node) {
  Ray ray = rayOfTexel(m, s, x, node, 1);
  // Its sources are smoother than sunlight: a panel less costs no accuracy that the others leave.
  int panels = int(s.solverPanels) - (s.solverPanels > REAL(3.5) ? 1 : 0);
  PathLight light = integrateInscattering(m, s, ray, ray.extent, panels, false, true);
  Spectrum sum = light.multiple;
  if (ALPENGLOW_GROUND_REFLECTION) {
    Spectrum up = m.groundAlbedo / REAL(ALPENGLOW_PI) * exp(-light.depth) *
                  fieldIrradiance(m, s, REAL(0.0), muSAtGround(m, ray));
    sum += ray.hitsGround ? up : SPECTRUM(REAL(0.0));
  }
  return sum;
}

// --- Pass F: the integral of L cos(m phi) over a zenith angle, eight modes at once, since their sums share the
// phase functions. x = group + modeGroups * zenith; the modes are 8 group ... 8 group + 7.

ALPENGLOW_FN int modeGroups(IN(MomentShape) s) { return (int(s.degree) + 8) / 8; }

// Weight of an azimuth: half a turn, twice.
ALPENGLOW_FN Real ringStep(IN(MomentShape) s) { return REAL(2.0) * REAL(ALPENGLOW_PI) / s.azimuths; }

struct EightModes {
  Spectrum a, b, c, d, e, f, g, h;
};

// Adds light at azimuth phi: cos((m + 1) phi) = 2 cos(phi) cos(m phi) - cos((m - 1) phi).
ALPENGLOW_FN EightModes addLight(IN(EightModes) sum, Spectrum light, Real mode, Real phi) {
  EightModes r;
  Real twice = REAL(2.0) * cos(phi);
  Real c0 = cos(mode * phi);
  Real c1 = cos((mode + REAL(1.0)) * phi);
  Real c2 = twice * c1 - c0;
  Real c3 = twice * c2 - c1;
  Real c4 = twice * c3 - c2;
  Real c5 = twice * c4 - c3;
  Real c6 = twice * c5 - c4;
  r.a = sum.a + light * c0;
  r.b = sum.b + light * c1;
  r.c = sum.c + light * c2;
  r.d = sum.d + light * c3;
  r.e = sum.e + light * c4;
  r.f = sum.f + light * c5;
  r.g = sum.g + light * c6;
  r.h = sum.h + light * (twice * c6 - c5);
  return r;
}

// Order 1: its light between two azimuths is linear, but for the phase functions, which are taken
// kFineAzimuths times between. Beyond the first and the last azimuth the light goes on as their
// mirror image, and counts half.
ALPENGLOW_FN EightModes singleModes(IN(Medium) m, IN(MomentShape) s, int first, int node, Real mode,
                                    Real cosines, Real sines, IN(EightModes) none) {
  EightModes sum = none;
  int azimuths = int(s.azimuths);
  const Spectrum kNone = SPECTRUM(REAL(0.0));
  Spectrum rayleigh = fetchRadiance(first, node);
  Spectrum mie = ALPENGLOW_MIE ? fetchRadianceMie(first, node) : kNone;
  Spectrum ground = ALPENGLOW_GROUND_REFLECTION ? fetchRadianceGround(first, node) : kNone;
  for (int i = 0; i <= azimuths; ++i) {
    int next = first + min(i, azimuths - 1);
    Spectrum nextRayleigh = fetchRadiance(next, node);
    Spectrum nextMie = ALPENGLOW_MIE ? fetchRadianceMie(next, node) : kNone;
    Spectrum nextGround = ALPENGLOW_GROUND_REFLECTION ? fetchRadianceGround(next, node) : kNone;
    Real weight = ringStep(s) * (i == 0 || i == azimuths ? REAL(0.5) : REAL(1.0)) / Real(kFineAzimuths);
    for (int k = 0; k < kFineAzimuths; ++k) {
      Real share = (Real(k) + REAL(0.5)) / Real(kFineAzimuths);
      Real phi = (Real(i) + share - REAL(0.5)) * REAL(ALPENGLOW_PI) / s.azimuths;
      Real nu = clamp(cosines + sines * cos(phi), REAL(-1.0), REAL(1.0));
      Spectrum light = kNone;
      if (ALPENGLOW_RAYLEIGH) light = mix(rayleigh, nextRayleigh, share) * rayleighPhase(nu);
      if (ALPENGLOW_MIE) light += mix(mie, nextMie, share) * miePhase(m.mieAsymmetry, nu);
      if (ALPENGLOW_GROUND_REFLECTION) light += mix(ground, nextGround, share);
      sum = addLight(sum, light * weight, mode, phi);
    }
    rayleigh = nextRayleigh;
    mie = nextMie;
    ground = nextGround;
  }
  return sum;
}

ALPENGLOW_FN EightModes multipleModes(IN(MomentShape) s, int first, int node, Real mode,
                                      IN(EightModes) none) {
  EightModes sum = none;
  for (int i = 0; i < int(s.azimuths); ++i) {
    Real phi = (Real(i) + REAL(0.5)) * REAL(ALPENGLOW_PI) / s.azimuths;
    sum = addLight(sum, fetchRadiance(first + i, node) * ringStep(s), mode, phi);
  }
  return sum;
}

ALPENGLOW_FN EightModes modesOfZenith(IN(Medium) m, IN(MomentShape) s, int x, int node,
                                      bool firstOrder) {
  int index = x / modeGroups(s);
  Real mode = REAL(8.0) * Real(x - index * modeGroups(s));
  int first = int(s.azimuths) * index;
  EightModes sum;
  sum.a = sum.b = sum.c = sum.d = sum.e = sum.f = sum.g = sum.h = SPECTRUM(REAL(0.0));
  if (firstOrder) {
    NodePoint p = nodePoint(m, s, node);
    ZenithAngle zenith = makeZenithAngle(m, s, p.h, index, kFineZeniths, fetchRule(index, 1));
    Real sines = sqrt(max((REAL(1.0) - zenith.mu * zenith.mu) * (REAL(1.0) - p.muS * p.muS), REAL(0.0)));
    sum = singleModes(m, s, first, node, mode, zenith.mu * p.muS, sines, sum);
  } else {
    sum = multipleModes(s, first, node, mode, sum);
  }
  return sum;
}

// --- Pass Y: Legendre functions. x = l (l + 1) / 2 + m.

// Rows of the table of Legendre functions: the zenith angles of each altitude, those of order 1, and the
// angles of the sources. The functions are stored times the common factor of every sum over them: the
// zenith angle's weight, or the aerosols' coefficient.
ALPENGLOW_FN int legendreRow(IN(MomentShape) s, int r, int zenith, int fine) {
  int coarse = zenithCount(s, 1) * int(s.nodesR);
  return fine == 1 ? r * zenithCount(s, 1) + zenith : coarse + r * zenithCount(s, kFineZeniths) + zenith;
}

ALPENGLOW_FN int legendreRowOfSource(IN(MomentShape) s, int gamma) {
  return zenithCount(s, 1 + kFineZeniths) * int(s.nodesR) + gamma;
}

ALPENGLOW_FN Real nuOfSource(IN(MomentShape) s, int gamma) {
  return sourceNu(s, texelToU(Real(gamma), s.sourceGamma));
}

ALPENGLOW_FN Real legendreOfTexel(IN(Medium) m, IN(MomentShape) s, int x, int y) {
  int coarse = zenithCount(s, 1);
  int fine = zenithCount(s, kFineZeniths);
  int fineRow = y - coarse * int(s.nodesR);
  int sourceRow = y - legendreRowOfSource(s, 0);
  bool isFine = fineRow >= 0;
  int r = isFine ? fineRow / fine : y / coarse;
  int zenith = isFine ? fineRow - r * fine : y - r * coarse;
  int l = degreeOf(x);
  int mode = x - l * (l + 1) / 2;
  Real factor = mode == 0 ? REAL(1.0) : REAL(1.41421356237309505);
  Real mu;
  if (sourceRow >= 0) {
    mu = nuOfSource(s, sourceRow);
    Real share = Real(l) / (s.degree + REAL(1.0));
    factor *= mieCoefficient(m.mieAsymmetry, l) * exp(-s.taper * share * share * share * share);
  } else {
    Real h = nodeH(m, s, texelToU(Real(r), s.nodesR));
    ZenithAngle cone = makeZenithAngle(m, s, h, zenith, isFine ? kFineZeniths : 1, fetchRule(zenith, isFine ? 1 : 0));
    mu = cone.mu;
    factor *= cone.weight;
  }
  return legendre(l, mode, mu) * factor;
}

// --- Pass M: the coefficient of L for harmonic x = l (l + 1) / 2 + m.

ALPENGLOW_FN Spectrum momentOfNode(IN(MomentShape) s, int x, int node, bool firstOrder) {
  int fine = firstOrder ? kFineZeniths : 1;
  int l = degreeOf(x);
  int mode = x - l * (l + 1) / 2;
  int modes = int(s.degree) + 1;
  int zeniths = zenithCount(s, fine);
  int row = legendreRow(s, node / int(s.nodesMuS), 0, fine);
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int i = 0; i < zeniths; ++i)
    sum += fetchModes(mode + modes * i, node) * fetchLegendre(x, row + i);
  return sum;
}

// --- Pass W: the rotations of each sun angle. x = from + (l + 1) to, y = l + (degree + 1) i_mus.

ALPENGLOW_FN Real rotationOfTexel(IN(MomentShape) s, int x, int y) {
  int degrees = int(s.degree) + 1;
  int node = y / degrees;
  int l = y - node * degrees;
  int to = min(x / (l + 1), l);
  Real muS = nodeMuS(s, texelToU(Real(node), s.nodesMuS));
  return rotation(l, to, min(x - to * (l + 1), l), muS);
}

// --- Pass R: the same coefficients about the sun.

ALPENGLOW_FN Spectrum turnedMoment(IN(MomentShape) s, int x, int node) {
  int l = degreeOf(x);
  int first = l * (l + 1) / 2;
  int row = l + (int(s.degree) + 1) * (node % int(s.nodesMuS));
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int from = 0; from <= l; ++from)
    sum += fetchMoments(first + from, node) * fetchRotation(from + (l + 1) * (x - first), row);
  return sum;
}

// --- Pass H: mode m about the sun of what aerosols scatter into angle gamma. x = gamma + gammas * m.

ALPENGLOW_FN Spectrum sourceModeOfNode(IN(MomentShape) s, int x, int node) {
  int gammas = int(s.sourceGamma);
  int mode = x / gammas;
  int row = legendreRowOfSource(s, x - mode * gammas);
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int l = mode; l <= int(s.degree); ++l) {
    int harmonic = l * (l + 1) / 2 + mode;
    sum += fetchMoments(harmonic, node) * fetchLegendre(harmonic, row);
  }
  return sum;
}

// --- Pass J: what aerosols scatter, per beta_M. x = gamma + gammas * psi, y = i_mus, z = i_r.

ALPENGLOW_FN Spectrum sourceOfTexel(IN(MomentShape) s, int x, int node) {
  int gammas = int(s.sourceGamma);
  int index = x / gammas;
  int modes = int(s.degree) + 1;
  int gamma = x - index * gammas;
  Real psi = REAL(ALPENGLOW_PI) * texelToU(Real(index), s.sourcePsi);
  // cos((m + 1) psi) = 2 cos(psi) cos(m psi) - cos((m - 1) psi).
  Real twice = REAL(2.0) * cos(psi);
  Real before = cos(psi);
  Real now = REAL(1.0);
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int mode = 0; mode < modes; ++mode) {
    sum += fetchSourceModes(gamma + gammas * mode, node) * now;
    Real next = twice * now - before;
    before = now;
    now = next;
  }
  return max(sum, SPECTRUM(REAL(0.0)));
}

// What the table of sources stores relative to: N G(nu) of the texel.
ALPENGLOW_FN Spectrum sourceNorm(IN(MomentShape) s, int x, Spectrum mean) {
  return mean * sourceShape(s, nuOfSource(s, x % int(s.sourceGamma)));
}

// --- Pass N: mean radiance, second moments over it, and irradiance of a node.

struct NodeField {
  Spectrum mean;         // N
  Spectrum xx, zz, xz;   // integrals of L w_i w_j over the sphere, divided by 4 pi
  Spectrum irradiance;   // E on a horizontal surface, equation 15
};

ALPENGLOW_FN NodeField fieldOfNode(IN(Medium) m, IN(MomentShape) s, int node, bool firstOrder) {
  int fine = firstOrder ? kFineZeniths : 1;
  NodeField field;
  const Real kSphere = REAL(1.0) / (REAL(4.0) * REAL(ALPENGLOW_PI));
  // From the harmonics of degree 0 and 2; x^2 - y^2 and x z are Y_22 and Y_21 but for a factor.
  field.mean = fetchMoments(0, node) * (REAL(3.5449077018110320) * kSphere);
  Spectrum p2 = fetchMoments(3, node) * (REAL(1.5853309190424043) * kSphere);
  field.zz = (field.mean + REAL(2.0) * p2) / REAL(3.0);
  Spectrum difference = fetchMoments(5, node) * (REAL(1.8305826292287) * kSphere);
  field.xx = REAL(0.5) * (field.mean - field.zz + difference);
  field.xz = fetchMoments(4, node) * (REAL(0.9152913146143) * kSphere);
  field.irradiance = SPECTRUM(REAL(0.0));
  int modes = int(s.degree) + 1;
  int sky = int(s.zenithsSky) * fine;
  NodePoint p = nodePoint(m, s, node);
  for (int i = 0; i < (ALPENGLOW_GROUND_REFLECTION || ALPENGLOW_GROUND_IRRADIANCE ? sky : 0); ++i) {
    ZenithAngle zenith = makeZenithAngle(m, s, p.h, i, fine, fetchRule(i, firstOrder ? 1 : 0));
    field.irradiance += fetchModes(modes * i, node) * (zenith.weight * zenith.mu);
  }
  return field;
}

// Layers of the table of moments as stored.
ALPENGLOW_FN Spectrum encodeLayer(IN(NodeField) field, int layer) {
  Spectrum dark = SPECTRUM(kMinRadiance);
  Spectrum mean = max(field.mean, dark);
  // Where there is no light, light from everywhere alike: 1/3, 1/3, 0.
  Spectrum third = SPECTRUM(REAL(1.0) / REAL(3.0)) * (mean - max(field.mean, SPECTRUM(REAL(0.0))));
  if (layer == 0) return log(mean);
  if (layer == 1) return clamp((field.xx + third) / mean, REAL(0.0), REAL(1.0));
  if (layer == 2) return clamp((field.zz + third) / mean, REAL(0.0), REAL(1.0));
  if (layer == 3) return clamp(field.xz / mean, REAL(-0.5), REAL(0.5));
  return log(max(field.irradiance, dark));
}

// --- The sum of the orders.

// Sum of the geometric series that follows the last order, over that order: q / (1 - q), q the ratio of
// the last two.
ALPENGLOW_FN Spectrum tailFactor(IN(MomentShape) s, Spectrum last, Spectrum before) {
  Spectrum q = clamp(last / max(before, SPECTRUM(kMinRadiance)), REAL(0.0), REAL(0.95));
  return q / (SPECTRUM(REAL(1.0)) - q) * s.tail;
}
