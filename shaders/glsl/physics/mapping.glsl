// Table coordinates (section 4 of the paper), both ways. A coordinate u in [0, 1] of a table
// dimension with n texels has 0 and 1 on the centres of its first and last texel.

// Texel-centre inset: u in [0, 1] to a texture coordinate, and texel index to u.
ALPENGLOW_FN Real insetCoordinate(Real u, Real n) { return (REAL(0.5) + u * (n - REAL(1.0))) / n; }

ALPENGLOW_FN Real texelToU(Real i, Real n) { return i / (n - REAL(1.0)); }

// --- T: (mu, r). u_r = sqrt(h / thickness); u_mu clusters texels at the horizon.

// tan(1.5): the ends of u_mu lie at +-1.5 rad of the arc tangent that spreads the horizon.
ALPENGLOW_FN Real transmittanceTan() { return REAL(14.1014199471717194); }

ALPENGLOW_FN Real2 transmittanceUv(IN(Medium) m, Real h, Real mu) {
  Real x = (mu - m.transmittanceMuMin) / (REAL(1.0) - m.transmittanceMuMin);
  return Real2(clamp(atan(x * transmittanceTan()) / REAL(1.5), REAL(0.0), REAL(1.0)),
               sqrt(clamp(h / m.thickness, REAL(0.0), REAL(1.0))));
}

ALPENGLOW_FN Real2 transmittanceHMu(IN(Medium) m, Real2 u) {
  Real x = tan(REAL(1.5) * u[0]) / transmittanceTan();
  return Real2(m.thickness * u[1] * u[1],
               min(m.transmittanceMuMin + x * (REAL(1.0) - m.transmittanceMuMin), REAL(1.0)));
}

// --- E: (mu_s, r), linear; below mu_s = -0.2 it holds its last value.

ALPENGLOW_FN Real2 irradianceUv(IN(Medium) m, Real h, Real muS) {
  return Real2(clamp((muS + REAL(0.2)) / REAL(1.2), REAL(0.0), REAL(1.0)),
               clamp(h / m.thickness, REAL(0.0), REAL(1.0)));
}

ALPENGLOW_FN Real2 irradianceHMuS(IN(Medium) m, Real2 u) {
  return Real2(m.thickness * u[1], REAL(-0.2) + REAL(1.2) * u[0]);
}

// --- S: (r, mu, mu_s, nu).

// u_r = rho / H.
ALPENGLOW_FN Real scatteringUr(IN(Medium) m, Real h) {
  return clamp(horizonRho(m, h) / m.topRho, REAL(0.0), REAL(1.0));
}

ALPENGLOW_FN Real scatteringH(IN(Medium) m, Real uR) {
  Real rho = uR * m.topRho;
  return min(rho * rho / (m.bottomRadius + sqrt(m.bottomRadius * m.bottomRadius + rho * rho)),
             m.thickness);
}

// u_mu: 0 (horizon) to 1/2 (nadir) for rays that hit the ground, 1/2 (zenith) to 1 (horizon) for
// those that don't; discontinuous at the horizon on purpose. The ground's branch is
// 1/2 + (r mu + sqrt(Delta)) / (2 rho), which is 0/0 at rho = 0 and cancels: this form doesn't.
ALPENGLOW_FN Real scatteringUmu(IN(Medium) m, Real h, Real mu, bool hitsGround) {
  Real rho = horizonRho(m, h);
  Real rMu = radiusAt(m, h) * mu;
  Real delta = max(rMu * rMu - rho * rho, REAL(0.0));
  Real ground = REAL(0.5) - rho / (REAL(2.0) * max(sqrt(delta) - rMu, REAL(1e-6)));
  Real sky = REAL(0.5) + distanceToTop(m, h, mu) / (REAL(2.0) * (rho + m.topRho));
  return hitsGround ? clamp(ground, REAL(0.0), REAL(0.5)) : clamp(sky, REAL(0.5), REAL(1.0));
}

ALPENGLOW_FN Real scatteringMu(IN(Medium) m, Real h, Real uMu, bool hitsGround) {
  Real rho = horizonRho(m, h);
  Real r = radiusAt(m, h);
  if (hitsGround) {
    Real d = max(rho * (REAL(1.0) - REAL(2.0) * uMu), h);  // distance to the ground
    return d > REAL(0.0) ? clamp(-(rho * rho + d * d) / (REAL(2.0) * r * d), REAL(-1.0), -rho / r)
                         : REAL(-1.0);
  }
  Real d = max((rho + m.topRho) * (REAL(2.0) * uMu - REAL(1.0)), m.thickness - h);  // to the top
  return d > REAL(0.0) ? clamp((topGapSquared(m, h) - d * d) / (REAL(2.0) * r * d), -rho / r,
                               REAL(1.0))
                       : REAL(1.0);
}

// The paper's u_mu counts distances from 0, but the shortest ray is as long as the zenith or nadir is
// away: texels below that stand for no ray, and scatteringMu gives them the shortest. This is the
// distance that they stand for as a share of it; 1 for the texels that rays map to.
ALPENGLOW_FN Real scatteringReach(IN(Medium) m, Real h, Real uMu, bool hitsGround) {
  Real rho = horizonRho(m, h);
  Real d = hitsGround ? rho * (REAL(1.0) - REAL(2.0) * uMu)
                      : (rho + m.topRho) * (REAL(2.0) * uMu - REAL(1.0));
  Real least = hitsGround ? h : m.thickness - h;
  return least > REAL(0.0) ? clamp(d / least, REAL(0.0), REAL(1.0)) : REAL(1.0);
}

// Texture coordinate of u_mu: each half of the n texels is inset by half a texel.
ALPENGLOW_FN Real scatteringCoordinateMu(Real uMu, bool hitsGround, Real n) {
  Real last = REAL(0.5) * n - REAL(1.0);
  Real texel = hitsGround ? REAL(2.0) * uMu * last
                          : REAL(0.5) * n + (REAL(2.0) * uMu - REAL(1.0)) * last;
  return (texel + REAL(0.5)) / n;
}

ALPENGLOW_FN Real texelToScatteringUmu(Real i, bool hitsGround, Real n) {
  Real last = REAL(0.5) * n - REAL(1.0);
  return hitsGround ? REAL(0.5) * i / last : REAL(0.5) + REAL(0.5) * (i - REAL(0.5) * n) / last;
}

// u_mus = (1 - exp(-3 mu_s - 0.6)) / (1 - exp(-3.6)); below mu_s = -0.2 it holds its last value.
ALPENGLOW_FN Real scatteringUmuS(Real muS) {
  return clamp((REAL(1.0) - exp(REAL(-3.0) * muS - REAL(0.6))) /
                   (REAL(1.0) - exp(REAL(-3.6))),
               REAL(0.0), REAL(1.0));
}

ALPENGLOW_FN Real scatteringMuS(Real uMuS) {
  return clamp(-(REAL(0.6) + log(REAL(1.0) - uMuS * (REAL(1.0) - exp(REAL(-3.6))))) / REAL(3.0),
               REAL(-1.0), REAL(1.0));
}

// u_nu = (1 + nu) / 2.
ALPENGLOW_FN Real scatteringUnu(Real nu) {
  return clamp(REAL(0.5) * (REAL(1.0) + nu), REAL(0.0), REAL(1.0));
}
