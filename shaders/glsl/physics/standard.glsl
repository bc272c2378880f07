// Algorithm 4.1 of Bruneton & Neyret 2008, the `standard` solver: what one texel of each table holds.
// Kept as published: 500 trapezoids for T, 50 along a ray, 16 x 32 directions for J, 16 x 64 for E.
// The includer defines, besides what lookup.glsl asks for:
//   Spectrum readDeltaIrradiance(Real2 uv)                       dE of the order before
//   Spectrum readDeltaRadiance(Real3 uvw), readDeltaMie(uvw)     dS of the order before; its order 1 is
//                                                                Rayleigh and Mie without phase
//   Spectrum readDeltaSource(Real3 uvw)                          dJ
//   Spectrum readIncident(Real2 uv), readIncidentMie(Real2 uv)   dS at the zenith angles of J
// ALPENGLOW_FIRST_ORDER: true when the order before is single scattering.

const int kTransmittanceTrapezoids = 500;
const int kRayTrapezoids = 50;
const int kSphereTheta = 16;  // zenith angles over the whole sphere; twice as many azimuths
const int kHemisphereTheta = 16;  // over the upper half; four times as many azimuths

// A texel of T. Down to two texels below the horizon the rays go on through the ground, and there the
// table stays: what is read at the horizon lies between texels on both sides of it, and must not see a
// step (with the horizon's value below, the sky's lowest 0.1 degrees were 40 % too bright).
ALPENGLOW_FN Spectrum tabulatedOpticalDepth(IN(Medium) m, IN(TableShape) shape, Real h, Real mu) {
  Real uHorizon = transmittanceUv(m, h, horizonMu(m, h))[0];
  Real uLeast = max(uHorizon - REAL(2.0) / (shape.transmittanceMu - REAL(1.0)), REAL(0.0));
  Real2 least = transmittanceHMu(m, Real2(uLeast, REAL(0.0)));
  return opticalDepthThroughGround(m, h, max(mu, least[1]), kTransmittanceTrapezoids);
}

// Optical depth from a point of a ray towards the top; a ray that hits the ground is looked up in
// reverse, so that it does not look below its horizon.
ALPENGLOW_FN Spectrum opticalDepthAlong(IN(Medium) m, IN(TableShape) shape, Real h, Real mu,
                                        bool hitsGround) {
  return opticalDepthFromTable(m, shape, h, hitsGround ? -mu : mu);
}

// T(x, y), equation 5, from the opticalDepthAlong of x and of y further along the ray: a quotient of
// transmittances towards the top, taken as a difference of optical depths.
ALPENGLOW_FN Spectrum transmittanceBetween(Spectrum depthX, Spectrum depthY, bool hitsGround) {
  Spectrum difference = hitsGround ? depthY - depthX : depthX - depthY;
  return exp(-max(difference, SPECTRUM(REAL(0.0))));
}

// E[L0]: direct irradiance on the ground, the dE that order 2 starts from.
ALPENGLOW_FN Spectrum directIrradiance(IN(Medium) m, IN(TableShape) shape, Real h, Real muS) {
  return transmittanceToSun(m, shape, h, muS) * max(muS, REAL(0.0));
}

// What S of the shortest ray is multiplied with in a texel that stands for no ray, because it is shorter
// still (`reach` of scatteringReach): S of a homogeneous layer of the same optical depth, at that share
// of its thickness. The rays next to the zenith and nadir are interpolated with such texels; with S of
// the shortest ray itself there, the nadir from 1 km came out 43 % too bright.
ALPENGLOW_FN Spectrum shorterRay(IN(Medium) m, IN(TableShape) shape, Real h, Real mu,
                                 bool hitsGround, Real reach) {
  Spectrum depth = opticalDepthAlong(m, shape, h, mu, hitsGround);
  Spectrum atGround = opticalDepthAlong(m, shape, REAL(0.0), REAL(-1.0), true);
  depth = hitsGround ? atGround - depth : depth;
  // Thinner than this, the quotient is `reach` itself, and would be 0/0.
  depth = max(depth, SPECTRUM(REAL(1e-3)));
  Spectrum one = SPECTRUM(REAL(1.0));
  Spectrum share = (one - exp(-depth * reach)) / (one - exp(-depth));
  return reach < REAL(1.0) ? share : one;
}

// S[L0], equation 11 for one event, without phase functions: Rayleigh and Mie apart.
ALPENGLOW_FN void singleScattering(IN(Medium) m, IN(TableShape) shape, Real h, Real mu, Real muS,
                                   Real nu, bool hitsGround, OUT(Spectrum) rayleigh,
                                   OUT(Spectrum) mie) {
  Real dx = (hitsGround ? distanceToGround(m, h, mu) : distanceToTop(m, h, mu)) /
            Real(kRayTrapezoids);
  Spectrum depthX = opticalDepthAlong(m, shape, h, mu, hitsGround);
  rayleigh = SPECTRUM(REAL(0.0));
  mie = SPECTRUM(REAL(0.0));
  for (int i = 0; i <= kRayTrapezoids; ++i) {
    Real t = Real(i) * dx;
    Real ht = min(altitudeAt(m, h, mu, t), m.thickness);
    Real muT = muAt(m, h, mu, t, ht);
    Spectrum depthY = opticalDepthAlong(m, shape, ht, muT, hitsGround);
    Spectrum light = transmittanceBetween(depthX, depthY, hitsGround) *
                     transmittanceToSun(m, shape, ht, muSAt(m, h, muS, nu, t, ht));
    light *= (i == 0 || i == kRayTrapezoids) ? REAL(0.5) * dx : dx;
    rayleigh += light * rayleighDensity(m, ht);
    mie += light * mieDensity(m, ht);
  }
  rayleigh *= m.rayleighScattering;
  mie *= m.mieScattering;
}

// Light of the order before that arrives from a direction; `plane` is its scatteringCoordinate.
ALPENGLOW_FN Spectrum deltaRadiance(IN(Medium) m, IN(TableShape) shape, Real3 plane, Real nu) {
  Real2 slice = nuSlice(shape, nu);
  Real3 lower = plane + Real3(slice[0], REAL(0.0), REAL(0.0));
  Real3 upper = lower + Real3(REAL(1.0) / shape.scatteringNu, REAL(0.0), REAL(0.0));
  Spectrum radiance = mix(readDeltaRadiance(lower), readDeltaRadiance(upper), slice[1]);
  if (ALPENGLOW_FIRST_ORDER) {
    radiance = radiance * rayleighPhase(nu) + mix(readDeltaMie(lower), readDeltaMie(upper), slice[1]) *
                                                  miePhase(m.mieAsymmetry, nu);
  }
  return radiance;
}

// Unit vector towards the sun in the frame of J, where the view is (sqrt(1 - mu^2), 0, mu).
ALPENGLOW_FN Real3 sunInViewFrame(Real mu, Real muS, Real nu) {
  Real sine = sqrt(max(REAL(1.0) - mu * mu, REAL(0.0)));
  Real limit = sqrt(max(REAL(1.0) - muS * muS, REAL(0.0)));
  Real x = sine > REAL(0.0) ? clamp((nu - muS * mu) / sine, -limit, limit) : REAL(0.0);
  return Real3(x, sqrt(max(limit * limit - x * x, REAL(0.0))), muS);
}

// A direction turned by an angle, both as (cosine, sine).
ALPENGLOW_FN Real2 turned(Real2 direction, Real2 angle) {
  return Real2(direction[0] * angle[0] - direction[1] * angle[1],
               direction[1] * angle[0] + direction[0] * angle[1]);
}

// Zenith angle i of J's quadrature.
ALPENGLOW_FN Real sphereTheta(int i) {
  return (Real(i) + REAL(0.5)) * REAL(ALPENGLOW_PI) / Real(kSphereTheta);
}

// J reads dS at r and mu_s of its own texel and at kSphereTheta zenith angles: all on nodes but nu. So
// dS is first interpolated to those angles, into a small 2D table with x = nu + nus * i and
// y = mu_s + muSs * r (texels), and J reads that: the same sums, in a third of the time.
ALPENGLOW_FN Real2 incidentCoordinate(IN(TableShape) shape, Real muSTexel, Real rTexel, int i,
                                      Real nu) {
  Real x = Real(i) + insetCoordinate(scatteringUnu(nu), shape.scatteringNu);
  Real y = muSTexel + shape.scatteringMuS * rTexel + REAL(0.5);
  return Real2(x / Real(kSphereTheta), y / (shape.scatteringMuS * shape.scatteringR));
}

// Radiance of the order before at a node nu of direction i, and its Mie part if that is kept apart.
ALPENGLOW_FN void incidentRadiance(IN(Medium) m, IN(TableShape) shape, Real h, Real muS, Real nu,
                                   int i, OUT(Spectrum) radiance, OUT(Spectrum) mie) {
  Real cosTheta = cos(sphereTheta(i));
  Real2 slice = nuSlice(shape, nu);
  Real3 lower = scatteringCoordinate(m, shape, h, cosTheta, muS, rayHitsGround(m, h, cosTheta)) +
                Real3(slice[0], REAL(0.0), REAL(0.0));
  Real3 upper = lower + Real3(REAL(1.0) / shape.scatteringNu, REAL(0.0), REAL(0.0));
  radiance = mix(readDeltaRadiance(lower), readDeltaRadiance(upper), slice[1]);
  mie = mix(readDeltaMie(lower), readDeltaMie(upper), slice[1]);
}

// What one texel of J shares between its directions.
struct DensityPoint {
  Real h;
  Real muSTexel;
  Real rTexel;
  Real muS;
  Real3 view;
  Real3 sun;
  Spectrum betaR;
  Spectrum betaM;
};

// Zenith angle i: light that arrives from its azimuths and is scattered towards the view.
// `withGround` is a literal: zenith angles above the horizon have no code for the ground.
ALPENGLOW_FN Spectrum densityOfZenith(IN(Medium) m, IN(TableShape) shape, IN(DensityPoint) p, int i,
                                      bool withGround) {
  Real step = REAL(ALPENGLOW_PI) / Real(kSphereTheta);
  Real cosTheta = cos(sphereTheta(i));
  Real sinTheta = sin(sphereTheta(i));
  Real dGround = REAL(0.0);
  Spectrum ground = SPECTRUM(REAL(0.0));
  if (withGround) {
    dGround = distanceToGround(m, p.h, cosTheta);
    Real muGround = muAt(m, p.h, cosTheta, dGround, REAL(0.0));
    ground = m.groundAlbedo / REAL(ALPENGLOW_PI) *
             transmittanceBetween(opticalDepthAlong(m, shape, p.h, cosTheta, true),
                                  opticalDepthAlong(m, shape, REAL(0.0), muGround, true), true);
  }
  Real2 azimuth = Real2(cos(REAL(0.5) * step), sin(REAL(0.5) * step));
  Real2 turn = Real2(cos(step), sin(step));
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int j = 0; j < 2 * kSphereTheta; ++j) {
    Real3 w = Real3(azimuth[0] * sinTheta, azimuth[1] * sinTheta, cosTheta);
    azimuth = turned(azimuth, turn);
    Real nuSun = dot(p.sun, w);
    Real nuView = dot(p.view, w);
    Real2 at = incidentCoordinate(shape, p.muSTexel, p.rTexel, i, nuSun);
    Spectrum arriving = readIncident(at);
    if (ALPENGLOW_FIRST_ORDER) {
      arriving = arriving * rayleighPhase(nuSun) +
                 readIncidentMie(at) * miePhase(m.mieAsymmetry, nuSun);
    }
    if (withGround) {
      Real muSGround = muSAt(m, p.h, p.muS, nuSun, dGround, REAL(0.0));
      arriving +=
          ground * readDeltaIrradiance(irradianceCoordinate(m, shape, REAL(0.0), muSGround));
    }
    sum += arriving * (p.betaR * rayleighPhase(nuView) + p.betaM * miePhase(m.mieAsymmetry, nuView));
  }
  return sum * (step * step * sinTheta);
}

// J[T alpha / pi dE + dS], equation 7, times the thickness of the atmosphere (per metre it would be
// below the smallest half float).
ALPENGLOW_FN Spectrum scatteringDensity(IN(Medium) m, IN(TableShape) shape, Real muSTexel,
                                        Real rTexel, Real h, Real mu, Real muS, Real nu) {
  DensityPoint p;
  p.h = h;
  p.muSTexel = muSTexel;
  p.rTexel = rTexel;
  p.muS = muS;
  p.view = Real3(sqrt(max(REAL(1.0) - mu * mu, REAL(0.0))), REAL(0.0), mu);
  p.sun = sunInViewFrame(mu, muS, nu);
  p.betaR = m.rayleighScattering * rayleighDensity(m, h);
  p.betaM = m.mieScattering * mieDensity(m, h);
  int skyZeniths = 0;
  for (int i = 0; i < kSphereTheta; ++i) {
    skyZeniths += rayHitsGround(m, h, cos(sphereTheta(i))) ? 0 : 1;
  }
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int i = 0; i < skyZeniths; ++i) sum += densityOfZenith(m, shape, p, i, false);
  for (int i = skyZeniths; i < kSphereTheta; ++i) sum += densityOfZenith(m, shape, p, i, true);
  return sum * m.thickness;
}

// E[dS], equation 15, on a horizontal surface.
ALPENGLOW_FN Spectrum diffuseIrradiance(IN(Medium) m, IN(TableShape) shape, Real h, Real muS) {
  Real step = REAL(0.5) * REAL(ALPENGLOW_PI) / Real(kHemisphereTheta);
  Real3 sun = Real3(sqrt(max(REAL(1.0) - muS * muS, REAL(0.0))), REAL(0.0), muS);
  Real2 turn = Real2(cos(step), sin(step));
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int i = 0; i < kHemisphereTheta; ++i) {
    Real theta = (Real(i) + REAL(0.5)) * step;
    Real cosTheta = cos(theta);
    Real sinTheta = sin(theta);
    Real3 plane = scatteringCoordinate(m, shape, h, cosTheta, muS, false);
    Real2 azimuth = Real2(cos(REAL(0.5) * step), sin(REAL(0.5) * step));
    for (int j = 0; j < 4 * kHemisphereTheta; ++j) {
      Real3 w = Real3(azimuth[0] * sinTheta, azimuth[1] * sinTheta, cosTheta);
      azimuth = turned(azimuth, turn);
      sum += deltaRadiance(m, shape, plane, dot(sun, w)) *
             (cosTheta * sinTheta * step * step);
    }
  }
  return sum;
}

// dS = integral of T dJ along the ray, equation 11.
ALPENGLOW_FN Spectrum multipleScattering(IN(Medium) m, IN(TableShape) shape, Real h, Real mu,
                                         Real muS, Real nu, bool hitsGround) {
  Real dx = (hitsGround ? distanceToGround(m, h, mu) : distanceToTop(m, h, mu)) /
            Real(kRayTrapezoids);
  Real2 slice = nuSlice(shape, nu);  // nu is constant along a ray
  Spectrum depthX = opticalDepthAlong(m, shape, h, mu, hitsGround);
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int i = 0; i <= kRayTrapezoids; ++i) {
    Real t = Real(i) * dx;
    Real ht = min(altitudeAt(m, h, mu, t), m.thickness);
    Real muT = muAt(m, h, mu, t, ht);
    Real3 lower = Real3(slice[0], REAL(0.0), REAL(0.0)) +
                  scatteringCoordinate(m, shape, ht, muT, muSAt(m, h, muS, nu, t, ht), hitsGround);
    Real3 upper = lower + Real3(REAL(1.0) / shape.scatteringNu, REAL(0.0), REAL(0.0));
    Spectrum source = mix(readDeltaSource(lower), readDeltaSource(upper), slice[1]);
    Spectrum depthY = opticalDepthAlong(m, shape, ht, muT, hitsGround);
    sum += transmittanceBetween(depthX, depthY, hitsGround) * source *
           ((i == 0 || i == kRayTrapezoids) ? REAL(0.5) * dx : dx);
  }
  return sum / m.thickness;
}
