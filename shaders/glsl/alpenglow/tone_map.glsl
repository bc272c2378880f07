// Tone maps, a channel at a time: exposed linear radiance in, display-linear [0, 1] out (before the sRGB
// curve). Stands alone. The text compiles as C++ too, where ALPENGLOW_FN and min, max and pow are the
// includer's.
#ifndef ALPENGLOW_TONE_MAP
#define ALPENGLOW_TONE_MAP

#ifndef ALPENGLOW_FN
#define ALPENGLOW_FN
#endif

ALPENGLOW_FN float alpenglowToneLinear(float c) { return min(max(c, 0.0f), 1.0f); }

// Reinhard et al. 2002, equation 3.
ALPENGLOW_FN float alpenglowToneReinhard(float c) {
  float x = max(c, 0.0f);
  return x / (1.0f + x);
}

// A filmic curve: x (a x + b) / (x (c x + d) + e), a rational fit with a toe and a long shoulder
// (Narkowicz 2015, "ACES Filmic Tone Mapping Curve").
ALPENGLOW_FN float alpenglowToneFilmic(float c) {
  float x = min(max(c, 0.0f), 1e4f);
  float top = x * (2.51f * x + 0.03f);
  float bottom = x * (2.43f * x + 0.59f) + 0.14f;
  return min(max(top / bottom, 0.0f), 1.0f);
}

// Display-linear [0, 1] to the sRGB curve (IEC 61966-2-1).
ALPENGLOW_FN float alpenglowSrgbEncode(float x) {
  return x <= 0.0031308f ? 12.92f * x : 1.055f * pow(x, 1.0f / 2.4f) - 0.055f;
}

#endif
