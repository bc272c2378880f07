// The sky slice of a camera: light along all its rays, over azimuth from the sun and angle from the nadir,
// made anew for each camera and sun. Rows are dense towards the horizon on both of its sides, so it serves
// from the ground, where the sky fills half the sphere, to outer space, where it is a thin ring.

const int kSliceAzimuths = 64;
const int kSliceGroundRows = 48;
const int kSliceSkyRows = 112;

// Angles from the nadir, of the horizon and of the highest ray that meets the air (pi inside it). Given in
// place of zenith angles, which have no digits left for a planet far below.
struct SliceView {
  Real horizon;
  Real span;  // from the horizon to the highest ray
};

// u in [0, 1] of a ray on its side of the horizon, and back.
ALPENGLOW_FN Real sliceUnit(IN(SliceView) view, Real nadirAngle, bool hitsGround) {
  Real below = (view.horizon - nadirAngle) / max(view.horizon, REAL(1e-30));
  Real above = (nadirAngle - view.horizon) / max(view.span, REAL(1e-30));
  return sqrt(clamp(hitsGround ? below : above, REAL(0.0), REAL(1.0)));
}

ALPENGLOW_FN Real sliceNadirAngle(IN(SliceView) view, Real u, bool hitsGround) {
  return hitsGround ? view.horizon * (REAL(1.0) - u * u) : view.horizon + view.span * u * u;
}

// Texture coordinate; sineHalf: sine of half the azimuth, even and smooth at both its ends as the light is.
ALPENGLOW_FN Real2 sliceCoordinate(IN(SliceView) view, Real nadirAngle, Real sineHalf,
                                   bool hitsGround) {
  Real rows = Real(kSliceGroundRows + kSliceSkyRows);
  Real u = sliceUnit(view, nadirAngle, hitsGround);
  Real texel = hitsGround ? u * Real(kSliceGroundRows - 1)
                          : Real(kSliceGroundRows) + u * Real(kSliceSkyRows - 1);
  return Real2(insetCoordinate(sineHalf, Real(kSliceAzimuths)), (texel + REAL(0.5)) / rows);
}

// Angle between a direction and the nadir from its zenith cosine and from sin^2 of half that angle, which
// keeps its digits near the nadir.
ALPENGLOW_FN Real angleFromNadir(Real mu, Real sineHalfSquared) {
  Real near_ = REAL(2.0) * arcSineOfSmall(sqrt(min(sineHalfSquared, REAL(0.25))));
  return mu < REAL(-0.5) ? near_ : arcCosine(-mu);
}
