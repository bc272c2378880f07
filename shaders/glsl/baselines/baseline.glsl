// What the simpler models share. They read the standard solver's table of optical depths (physics/lookup.glsl,
// ALPENGLOW_TABLE_READS); everything is per unit solar irradiance. docs/baselines.md says what each is.

// Mirrored by BaselineConstants in atmosphere/baselines/baseline_graph.cpp, behind Medium and TableShape.
struct BaselineSettings {
  Real stepCount;  // points along a ray
  Real unused0, unused1, unused2;
};

// Light scattered into a ray along a segment of it, and the optical depth of that segment.
struct BaselineLight {
  Spectrum light;
  Spectrum depth;
};

// (1 - exp(-x)) / x, precise for small x: the share of its own light that leaves a medium of constant density and
// optical depth x.
ALPENGLOW_FN Spectrum lightLetOut(Spectrum x) {
  Spectrum one = SPECTRUM(REAL(1.0));
  Spectrum least = SPECTRUM(REAL(0.02));
  Spectrum small_ = min(x, least);
  Spectrum series = one - small_ * (one - small_ * (one - small_ * REAL(0.25)) / REAL(3.0)) * REAL(0.5);
  Spectrum quotient = (one - exp(-x)) / max(x, least);
  return mix(series, quotient, step(least, x));
}
