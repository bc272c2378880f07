// Global tone maps: exposed linear radiance in, display-linear [0, 1] out (before the sRGB curve).

ALPENGLOW_FN Real3 toneMapLinear(Real3 c) { return clamp(c, Real3(REAL(0.0)), Real3(REAL(1.0))); }

// Reinhard et al. 2002, equation 3, on each channel.
ALPENGLOW_FN Real3 toneMapReinhard(Real3 c) {
  Real3 x = max(c, Real3(REAL(0.0)));
  return x / (Real3(REAL(1.0)) + x);
}

// A filmic curve: x (a x + b) / (x (c x + d) + e), a rational fit with a toe and a long shoulder
// (Narkowicz 2015, "ACES Filmic Tone Mapping Curve").
ALPENGLOW_FN Real3 toneMapFilmic(Real3 c) {
  Real3 x = min(max(c, Real3(REAL(0.0))), Real3(REAL(1e4)));
  Real3 top = x * (REAL(2.51) * x + Real3(REAL(0.03)));
  Real3 bottom = x * (REAL(2.43) * x + Real3(REAL(0.59))) + Real3(REAL(0.14));
  return clamp(top / bottom, Real3(REAL(0.0)), Real3(REAL(1.0)));
}

// Display-linear [0, 1] to the sRGB curve (IEC 61966-2-1), one channel.
ALPENGLOW_FN Real srgbEncode(Real x) {
  return x <= REAL(0.0031308) ? REAL(12.92) * x
                              : REAL(1.055) * pow(x, REAL(1.0) / REAL(2.4)) - REAL(0.055);
}
