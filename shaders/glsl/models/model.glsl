// What the simpler models share. They read the standard solver's table of optical depths (physics/lookup.glsl,
// ALPENGLOW_TABLE_READS); everything is per unit solar irradiance. docs/models.md says what each is.

// Mirrored by ModelConstants in atmosphere/models/model_plan.cpp, behind Medium and TableShape.
struct ModelSettings {
  Real samples;  // points along a ray
  Real unused0, unused1, unused2;
};

// Light scattered into a ray along a stretch of it, and that stretch's optical depth.
struct ModelLight {
  Spectrum light;
  Spectrum depth;
};

// (1 - exp(-x)) / x, which keeps its digits where x is small: the share of its light that air of constant
// density and optical depth x lets out.
ALPENGLOW_FN Spectrum lightLetOut(Spectrum x) {
  Spectrum one = SPECTRUM(REAL(1.0));
  Spectrum least = SPECTRUM(REAL(0.02));
  Spectrum small_ = min(x, least);
  Spectrum series = one - small_ * (one - small_ * (one - small_ * REAL(0.25)) / REAL(3.0)) * REAL(0.5);
  Spectrum quotient = (one - exp(-x)) / max(x, least);
  return mix(series, quotient, step(least, x));
}
