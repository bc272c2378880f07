// Phase functions. nu is the cosine of the angle between view and sun; 1/sr, integral 1.

// Section 2.1 of the paper: P_R.
ALPENGLOW_FN Real rayleighPhase(Real nu) {
  return REAL(3.0) / (REAL(16.0) * REAL(ALPENGLOW_PI)) * (REAL(1.0) + nu * nu);
}

// Cornette-Shanks, equation 4 of the paper: P_M with asymmetry g.
ALPENGLOW_FN Real miePhase(Real g, Real nu) {
  Real k = REAL(3.0) / (REAL(8.0) * REAL(ALPENGLOW_PI)) * (REAL(1.0) - abs(g)) *
           (REAL(1.0) + abs(g)) / (REAL(2.0) + g * g);
  // 1 + g^2 - 2 g nu as a sum of terms that don't cancel for g near 1 and nu near 1.
  Real d = (REAL(1.0) - abs(g)) * (REAL(1.0) - abs(g)) +
           REAL(2.0) * abs(g) * (REAL(1.0) - sign(g) * clamp(nu, REAL(-1.0), REAL(1.0)));
  return k * (REAL(1.0) + nu * nu) / (d * sqrt(d));
}
