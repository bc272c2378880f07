// The light field of the moment solver: the layout of its tables. It is solved on nodes (r, mu_s); a
// node keeps the mean radiance N, the second moments that Rayleigh scattering needs, the irradiance E, and
// what aerosols scatter into each direction. All per unit solar irradiance.

// Texels and the constants of the mappings, all computed in double by the bake
// (atmosphere/tables/moment_shape.cpp). The layout is std140.
struct MomentShape {
  Real depthMu, depthH;    // texels of the table of optical depths
  Real depthSharpness;     // c: u_mu = asinh(c mu) / asinh(c)
  Real heightScale;        // a: of the altitudes of both tables, see depthUv and nodeUr, m
  Real nodesR, nodesMuS;   // nodes
  Real fieldR, fieldMuS;   // texels of a layer of the table of moments, see fieldTexels
  Real sunCenter, sunWidth;  // theta_s = center + width sinh(low + u range), radians
  Real sunLow, sunRange;
  Real sourceGamma, sourcePsi;  // directions of the table of sources
  Real sourceSharpness;    // c: u_gamma = asinh(c gamma / pi) / asinh(c)
  Real peakAsymmetry;      // of the shape G(nu) that the sources are stored relative to
  Real peakShare;
  Real zenithsSky, zenithsLimb, zenithsGround;  // of incoming light, see makeZenithAngle
  Real azimuths;
  Real degree;             // of the spherical harmonics
  Real taper;              // of the highest ones, where a narrow peak would ring
  Real solverPanels, viewPanels;
  Real tail;               // 1: a geometric series stands for the orders that are not solved
  Real layers;             // of the table of moments: five, or four where nothing wants E
};

// asin of x in [0, 1/2] and acos to float accuracy: those of GPUs and lavapipe are off by up to 1e-4 rad.
ALPENGLOW_FN Real arcSineOfSmall(Real x) {
  Real z = x * x;
  return ((((REAL(4.2163199048e-2) * z + REAL(2.4181311049e-2)) * z + REAL(4.5470025998e-2)) * z +
           REAL(7.4953002686e-2)) * z + REAL(1.6666752422e-1)) * z * x + x;
}

ALPENGLOW_FN Real arcCosine(Real x) {
  Real a = abs(x);
  bool wide = a > REAL(0.5);
  Real p = arcSineOfSmall(wide ? sqrt(REAL(0.5) * (REAL(1.0) - a)) : a);
  Real positive = wide ? REAL(2.0) * p : REAL(0.5) * REAL(ALPENGLOW_PI) - p;
  return x < REAL(0.0) ? REAL(ALPENGLOW_PI) - positive : positive;
}

// --- Optical depth towards the top, of rays that rise (mu >= 0): those that sink are differences and
// sums of such (depthTowardsTop), which keeps the perigee exact.

ALPENGLOW_FN Real2 depthUv(IN(Medium) m, IN(MomentShape) s, Real h, Real mu) {
  return Real2(asinh(s.depthSharpness * mu) / asinh(s.depthSharpness),
               asinh(h / s.heightScale) / asinh(m.thickness / s.heightScale));
}

ALPENGLOW_FN Real2 depthHMu(IN(Medium) m, IN(MomentShape) s, Real2 u) {
  return Real2(min(s.heightScale * sinh(u[1] * asinh(m.thickness / s.heightScale)), m.thickness),
               min(sinh(u[0] * asinh(s.depthSharpness)) / s.depthSharpness, REAL(1.0)));
}

// What the table holds there: the mean extinction along the ray, as the optical depth of a ray as long as the
// shell is thick. The depth itself goes to 0 at the top with the ray's length, and the interpolation of its
// logarithm there made the sun 23 % wrong in an atmosphere that is dense up to the top.
ALPENGLOW_FN Spectrum depthAtUv(IN(Medium) m, IN(MomentShape) s, Real2 u) {
  Real2 at = depthHMu(m, s, u);
  Real h = min(at[0], m.thickness * REAL(0.999755859375));  // at the top itself there is no ray
  Real length_ = distanceToTop(m, h, at[1]);
  return encodeOpticalDepth(opticalDepthOfSegment(m, h, at[1], length_) * (m.thickness / length_));
}

ALPENGLOW_FN Real2 depthCoordinate(IN(Medium) m, IN(MomentShape) s, Real h, Real mu) {
  Real2 u = depthUv(m, s, h, mu);
  return Real2(insetCoordinate(u[0], s.depthMu), insetCoordinate(u[1], s.depthH));
}

// --- Nodes.

// The table of moments holds layers below each other: ln N, the second moments xx, zz and xz over N, and ln E.

// Least mean radiance or irradiance whose logarithm is stored, far below a starlit night (per unit solar
// irradiance).
const Real kMinRadiance = REAL(1e-30);

// The highest node: slightly below the top, where light from above vanishes and has no logarithm.
ALPENGLOW_FN Real highestNode(IN(Medium) m) { return m.thickness * REAL(0.99609375); }

// Like the square root of the altitude near the ground, as the horizon sinks, and like its logarithm above.
ALPENGLOW_FN Real nodeUr(IN(Medium) m, IN(MomentShape) s, Real h) {
  Real most = asinh(sqrt(highestNode(m) / s.heightScale));
  return min(asinh(sqrt(max(h, REAL(0.0)) / s.heightScale)) / most, REAL(1.0));
}

ALPENGLOW_FN Real nodeH(IN(Medium) m, IN(MomentShape) s, Real u) {
  Real root = sinh(u * asinh(sqrt(highestNode(m) / s.heightScale)));
  return s.heightScale * root * root;
}

// Densest around the terminator, where the field falls by orders of magnitude.
ALPENGLOW_FN Real nodeUmuS(IN(MomentShape) s, Real muS) {
  Real theta = arcCosine(clamp(muS, REAL(-1.0), REAL(1.0)));
  return clamp((asinh((theta - s.sunCenter) / s.sunWidth) - s.sunLow) / s.sunRange, REAL(0.0),
               REAL(1.0));
}

ALPENGLOW_FN Real nodeMuS(IN(MomentShape) s, Real u) {
  Real theta = s.sunCenter + s.sunWidth * sinh(s.sunLow + u * s.sunRange);
  return cos(clamp(theta, REAL(0.0), REAL(ALPENGLOW_PI)));
}

ALPENGLOW_FN Real2 nodeUv(IN(Medium) m, IN(MomentShape) s, Real h, Real muS) {
  return Real2(nodeUmuS(s, muS), nodeUr(m, s, h));
}

// Texture coordinate in the first layer of the table of moments; the next lie 1 / layers on.
ALPENGLOW_FN Real2 fieldCoordinate(IN(MomentShape) s, Real2 uv) {
  return Real2(insetCoordinate(uv[0], s.fieldMuS),
               insetCoordinate(uv[1], s.fieldR) / s.layers);
}

// --- Sources: directions by the angle gamma from the sun (from the point opposite it, for aerosols that
// scatter back) and the azimuth psi about it, 0 downwards. The peak about the sun has the same coordinates in all
// nodes, and gamma is constant along a ray.

// A direction in the frame of a point: z up, the sun in the x z plane.
ALPENGLOW_FN Real3 localDirection(Real mu, Real muS, Real nu) {
  Real sine = sqrt(max(REAL(1.0) - mu * mu, REAL(0.0)));
  Real sineS = sqrt(max(REAL(1.0) - muS * muS, REAL(0.0)));
  // Under a sun in the zenith nothing depends on the azimuth.
  Real x = sineS > REAL(1e-4) ? clamp((nu - mu * muS) / sineS, -sine, sine) : sine;
  return Real3(x, sqrt(max(sine * sine - x * x, REAL(0.0))), mu);
}

ALPENGLOW_FN Real peakSide(IN(MomentShape) s) {
  return s.peakAsymmetry < REAL(0.0) ? REAL(-1.0) : REAL(1.0);
}

ALPENGLOW_FN Real sourceNu(IN(MomentShape) s, Real u) {
  Real gamma = sinh(u * asinh(s.sourceSharpness)) / s.sourceSharpness;
  return peakSide(s) * cos(REAL(ALPENGLOW_PI) * min(gamma, REAL(1.0)));
}

// What is the same all along a ray.
struct SourceRay {
  Real nu;
  Real sine;   // of gamma
  Real x;      // texture coordinate of gamma at psi = 0
  Real shape;  // G(nu)
};

// G(nu), mean 1 over the sphere: about the shape of what aerosols scatter near the sun. The table holds the
// ratio to it, which is smoother.
ALPENGLOW_FN Real sourceShape(IN(MomentShape) s, Real nu) {
  Real g = s.peakAsymmetry;
  Real d = (REAL(1.0) - abs(g)) * (REAL(1.0) - abs(g)) +
           REAL(2.0) * abs(g) * (REAL(1.0) - sign(g) * clamp(nu, REAL(-1.0), REAL(1.0)));
  return REAL(1.0) - s.peakShare +
         s.peakShare * (REAL(1.0) - abs(g)) * (REAL(1.0) + abs(g)) / (d * sqrt(d));
}

ALPENGLOW_FN SourceRay makeSourceRay(IN(MomentShape) s, Real nu) {
  SourceRay ray;
  Real cosine = clamp(nu, REAL(-1.0), REAL(1.0));
  Real gamma = arcCosine(peakSide(s) * cosine) / REAL(ALPENGLOW_PI);
  Real u = asinh(s.sourceSharpness * gamma) / asinh(s.sourceSharpness);
  ray.nu = cosine;
  ray.sine = sqrt((REAL(1.0) - cosine) * (REAL(1.0) + cosine));
  ray.x = insetCoordinate(u, s.sourceGamma) / s.sourcePsi;
  ray.shape = sourceShape(s, cosine);
  return ray;
}

// psi in slices of the table. Towards the sun and away from it, and under a sun in the zenith, nothing
// depends on it.
ALPENGLOW_FN Real sourceSlice(IN(MomentShape) s, IN(SourceRay) ray, Real mu, Real muS) {
  Real sineS = sqrt(max((REAL(1.0) - muS) * (REAL(1.0) + muS), REAL(0.0)));
  Real cosine = (ray.nu * muS - mu) / max(ray.sine * sineS, REAL(1e-6));
  return arcCosine(clamp(cosine, REAL(-1.0), REAL(1.0))) / REAL(ALPENGLOW_PI) *
         (s.sourcePsi - REAL(1.0));
}
