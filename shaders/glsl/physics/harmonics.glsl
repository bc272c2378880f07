// Spherical harmonics about the zenith and about the sun. Light is mirrored in the plane of both, so only
// cosines of the azimuth occur: Y_lm = legendre(l, m, mu) {1, m = 0; sqrt(2) cos(m phi)}, orthonormal.

ALPENGLOW_FN Real legendre(int l, int m, Real mu) {
  Real sine = sqrt(max(REAL(1.0) - mu * mu, REAL(0.0)));
  Real diagonal = REAL(0.28209479177387814);  // Y_00
  for (int k = 1; k <= m; ++k) diagonal *= sqrt(REAL(1.0) + REAL(0.5) / Real(k)) * sine;
  Real before = REAL(0.0);
  Real now = diagonal;
  for (int k = m + 1; k <= l; ++k) {
    Real k2 = Real(k * k);
    Real m2 = Real(m * m);
    Real below = Real((k - 1) * (k - 1));
    Real a = sqrt((REAL(4.0) * k2 - REAL(1.0)) / (k2 - m2));
    Real b = sqrt((below - m2) / (REAL(4.0) * below - REAL(1.0)));
    Real next = a * (mu * now - (k > m + 1 ? b * before : REAL(0.0)));
    before = now;
    now = next;
  }
  return now;
}

// Degree of the harmonic with index x; its mode is x - l (l + 1) / 2.
ALPENGLOW_FN int degreeOf(int x) {
  int l = int(REAL(0.5) * (sqrt(REAL(8.0) * Real(x) + REAL(1.0)) - REAL(1.0)));
  // The root's rounding must not choose the neighbour.
  l += (l + 1) * (l + 2) / 2 <= x ? 1 : 0;
  return l - (l * (l + 1) / 2 > x ? 1 : 0);
}

// Coefficient l of Cornette-Shanks: 2 pi times the integral of P_M P_l. The phase function is
// Henyey-Greenstein's times 3/2 (1 + nu^2) / (2 + g^2), and nu^2 mixes three neighbours of g^l.
ALPENGLOW_FN Real mieCoefficient(Real g, int l) {
  Real k = Real(l);
  Real power = REAL(1.0);       // g^l
  Real powerBelow = REAL(0.0);  // g^(l - 2)
  for (int i = 0; i < l; ++i) {
    powerBelow = i == l - 2 ? power : powerBelow;
    power *= g;
  }
  Real up = (k + REAL(1.0)) * (k + REAL(2.0)) / ((REAL(2.0) * k + REAL(1.0)) * (REAL(2.0) * k + REAL(3.0)));
  Real own = (k + REAL(1.0)) * (k + REAL(1.0)) / ((REAL(2.0) * k + REAL(1.0)) * (REAL(2.0) * k + REAL(3.0))) +
             k * k / (REAL(4.0) * k * k - REAL(1.0));
  Real down = k * (k - REAL(1.0)) / (REAL(4.0) * k * k - REAL(1.0));
  // For l = 0 and 1 `down` is 0. up and down as P_k sees them: from P_{k+2} and P_{k-2}.
  return REAL(1.5) / (REAL(2.0) + g * g) *
         (power * (REAL(1.0) + own) + up * power * g * g + down * powerBelow);
}

// --- From the zenith's frame to the sun's, which is turned by the sun's zenith angle beta about the
// horizontal axis across their plane: its pole is the sun, its azimuth 0 points down.

// Wigner's d^l_{p q}(beta), p >= |q|, but for its sign (-1)^(p - q): from l = p upwards, which is stable.
ALPENGLOW_FN Real wignerD(int l, int p, int q, Real cosine) {
  Real halfCos = sqrt(max(REAL(0.5) * (REAL(1.0) + cosine), REAL(0.0)));
  Real halfSin = sqrt(max(REAL(0.5) * (REAL(1.0) - cosine), REAL(0.0)));
  Real now = REAL(1.0);
  for (int k = 1; k <= p + q; ++k) now *= halfCos;
  for (int k = 1; k <= p - q; ++k) now *= halfSin * sqrt(Real(p + q + k) / Real(k));
  Real before = REAL(0.0);
  for (int k = p; k < l; ++k) {
    Real n = Real(k);
    Real next = Real(k + 1);
    Real p2 = Real(p * p);
    Real q2 = Real(q * q);
    Real shift = k > 0 ? Real(p * q) / (n * next) : REAL(0.0);
    Real fall = k > 0 ? sqrt((n * n - p2) * (n * n - q2)) / (n * (REAL(2.0) * n + REAL(1.0))) : REAL(0.0);
    Real after = (REAL(2.0) * n + REAL(1.0)) * next / sqrt((next * next - p2) * (next * next - q2)) *
                 ((cosine - shift) * now - fall * before);
    before = now;
    now = after;
  }
  return now;
}

// What the harmonic (l, from) about the zenith adds to (l, to) about the sun.
ALPENGLOW_FN Real rotation(int l, int to, int from, Real cosine) {
  int p = max(to, from);
  int q = min(to, from);
  Real even = wignerD(l, p, q, cosine) * (to > from && (to - from) % 2 == 1 ? REAL(-1.0) : REAL(1.0));
  Real odd = wignerD(l, p, -q, cosine) * (to % 2 == 1 ? REAL(-1.0) : REAL(1.0));
  return p == 0 ? even : q == 0 ? REAL(1.41421356237309505) * even : even + odd;
}
