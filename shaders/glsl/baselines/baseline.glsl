// What the simpler models share. They read the standard solver's table of optical depths (physics/lookup.glsl,
// ALPENGLOW_TABLE_READS); everything is per unit solar irradiance. docs/baselines.md says what each is.

// Mirrored by BaselineConstants in atmosphere/baselines/baseline_graph.cpp, behind Medium and TableShape.
struct BaselineSettings {
  Real stepCount;  // points along a ray
  Real unused0, unused1, unused2;
};

// Light scattered into a ray along a segment of it, and that stretch's optical depth.
struct BaselineLight {
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
