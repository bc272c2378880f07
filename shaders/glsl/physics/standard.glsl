// Algorithm 4.1 of Bruneton & Neyret 2008, the `standard` solver: what one texel of each table holds.
// Kept as published: 500 trapezoids for T, 50 along a ray, 16 x 32 directions for J, 16 x 64 for E.
// The includer defines, besides what lookup.glsl asks for:
//   Spectrum readDeltaIrradiance(Real2 uv)                       dE of the order before
//   Spectrum readDeltaRadiance(Real3 uvw), readDeltaMie(uvw)     dS of the order before; its order 1 is
//                                                                Rayleigh and Mie without phase
//   Spectrum readDeltaSource(Real3 uvw)                          dJ
// ALPENGLOW_FIRST_ORDER: true when the order before is single scattering.

const int kTransmittanceTrapezoids = 500;
const int kRayTrapezoids = 50;
const int kSphereTheta = 16;  // zenith angles over the whole sphere; twice as many azimuths
const int kHemisphereTheta = 16;  // over the upper half; four times as many azimuths

// T(x, y), equation 5, between x and the point at distance d of its ray, from the table: a quotient of
// transmittances towards the top, taken as a difference of optical depths. A ray that hits the
// ground is looked up in reverse, so that neither end looks below its horizon.
ALPENGLOW_FN Spectrum transmittanceBetween(IN(Medium) m, IN(TableShape) shape, Real h, Real mu,
                                           Real hd, Real muD, bool hitsGround) {
  Real2 here = opticalDepthCoordinate(m, shape, h, hitsGround ? -mu : mu);
  Real2 there = opticalDepthCoordinate(m, shape, hd, hitsGround ? -muD : muD);
  Spectrum difference = readOpticalDepth(here) - readOpticalDepth(there);
  return exp(-max(hitsGround ? -difference : difference, SPECTRUM(REAL(0.0))));
}

// E[L0]: direct irradiance on the ground, the dE that order 2 starts from.
ALPENGLOW_FN Spectrum directIrradiance(IN(Medium) m, IN(TableShape) shape, Real h, Real muS) {
  return transmittanceToSun(m, shape, h, muS) * max(muS, REAL(0.0));
}

// S[L0], equation 11 for one event, without phase functions: Rayleigh and Mie apart.
ALPENGLOW_FN void singleScattering(IN(Medium) m, IN(TableShape) shape, Real h, Real mu, Real muS,
                                   Real nu, bool hitsGround, OUT(Spectrum) rayleigh,
                                   OUT(Spectrum) mie) {
  Real dx = (hitsGround ? distanceToGround(m, h, mu) : distanceToTop(m, h, mu)) /
            Real(kRayTrapezoids);
  rayleigh = SPECTRUM(REAL(0.0));
  mie = SPECTRUM(REAL(0.0));
  for (int i = 0; i <= kRayTrapezoids; ++i) {
    Real t = Real(i) * dx;
    Real ht = min(altitudeAt(m, h, mu, t), m.thickness);
    Real muT = muAt(m, h, mu, t, ht);
    Spectrum light = transmittanceBetween(m, shape, h, mu, ht, muT, hitsGround) *
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

// J[T alpha / pi dE + dS], equation 7, times the thickness of the atmosphere (per metre it would be
// below the smallest half float).
ALPENGLOW_FN Spectrum scatteringDensity(IN(Medium) m, IN(TableShape) shape, Real h, Real mu,
                                        Real muS, Real nu) {
  Real step = REAL(ALPENGLOW_PI) / Real(kSphereTheta);
  Real3 view = Real3(sqrt(max(REAL(1.0) - mu * mu, REAL(0.0))), REAL(0.0), mu);
  Real3 sun = sunInViewFrame(mu, muS, nu);
  Real2 turn = Real2(cos(step), sin(step));
  Spectrum betaR = m.rayleighScattering * rayleighDensity(m, h);
  Spectrum betaM = m.mieScattering * mieDensity(m, h);
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int i = 0; i < kSphereTheta; ++i) {
    Real theta = (Real(i) + REAL(0.5)) * step;
    Real cosTheta = cos(theta);
    Real sinTheta = sin(theta);
    bool hitsGround = rayHitsGround(m, h, cosTheta);
    Real dGround = distanceToGround(m, h, cosTheta);
    Real muGround = muAt(m, h, cosTheta, dGround, REAL(0.0));
    Spectrum ground =
        (hitsGround ? REAL(1.0) : REAL(0.0)) * m.groundAlbedo / REAL(ALPENGLOW_PI) *
        transmittanceBetween(m, shape, h, cosTheta, REAL(0.0), muGround, true);
    Real3 plane = scatteringCoordinate(m, shape, h, cosTheta, muS, hitsGround);
    Real2 azimuth = Real2(cos(REAL(0.5) * step), sin(REAL(0.5) * step));
    for (int j = 0; j < 2 * kSphereTheta; ++j) {
      Real3 w = Real3(azimuth[0] * sinTheta, azimuth[1] * sinTheta, cosTheta);
      azimuth = turned(azimuth, turn);
      Real nuSun = dot(sun, w);
      Real nuView = dot(view, w);
      Real muSGround = muSAt(m, h, muS, nuSun, hitsGround ? dGround : REAL(0.0), REAL(0.0));
      Spectrum arriving =
          ground * readDeltaIrradiance(irradianceCoordinate(m, shape, REAL(0.0), muSGround)) +
          deltaRadiance(m, shape, plane, nuSun);
      sum += arriving *
             (betaR * rayleighPhase(nuView) + betaM * miePhase(m.mieAsymmetry, nuView)) *
             (step * step * sinTheta);
    }
  }
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
  Spectrum sum = SPECTRUM(REAL(0.0));
  for (int i = 0; i <= kRayTrapezoids; ++i) {
    Real t = Real(i) * dx;
    Real ht = min(altitudeAt(m, h, mu, t), m.thickness);
    Real muT = muAt(m, h, mu, t, ht);
    Real3 lower = Real3(slice[0], REAL(0.0), REAL(0.0)) +
                  scatteringCoordinate(m, shape, ht, muT, muSAt(m, h, muS, nu, t, ht), hitsGround);
    Real3 upper = lower + Real3(REAL(1.0) / shape.scatteringNu, REAL(0.0), REAL(0.0));
    Spectrum source = mix(readDeltaSource(lower), readDeltaSource(upper), slice[1]);
    sum += transmittanceBetween(m, shape, h, mu, ht, muT, hitsGround) * source *
           ((i == 0 || i == kRayTrapezoids) ? REAL(0.5) * dx : dx);
  }
  return sum / m.thickness;
}
