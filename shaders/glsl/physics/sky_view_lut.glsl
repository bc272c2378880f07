// The sky-view LUT of a camera: light along all its rays, over azimuth from the sun and angle from the nadir,
// rebuilt for each camera and sun. Rows are dense towards the horizon on both of its sides, so it is usable
// from the ground, where the sky fills half the sphere, to outer space, where it is a thin ring.

// Angles from the nadir, of the horizon and of the highest ray that meets the atmosphere (pi inside it). They
// replace zenith angles, which lose precision for a planet far below.
struct SkyViewParams {
  Real horizon;
  Real span;  // from the horizon to the highest ray
  Real bend;  // the less, the denser the ground's rows next to the horizon
};

// The same for the sky's rows, for cameras inside the atmosphere.
ALPENGLOW_FN Real skyRowBend() { return REAL(0.8); }

// The highest ray's angle from the nadir is pi inside the atmosphere, less than a right angle outside.
ALPENGLOW_FN bool viewFromSpace(IN(SkyViewParams) view) {
  return ALPENGLOW_SPACE_VIEWS && view.horizon + view.span < REAL(2.0);
}

// The columns in use. In a view from space the terminator crosses them, where light falls by orders of
// magnitude; inside the atmosphere only twilight is left of it, and half of `columns` suffice. One more column is
// filled for the filter.
ALPENGLOW_FN Real azimuthColumns(IN(SkyViewParams) view, Real columns) {
  return viewFromSpace(view) ? columns : REAL(0.5) * columns - REAL(1.0);
}

// u in [0, 1] of a ray on its side of the horizon, and back. Light is smooth in the square root of the angle on
// both sides of the horizon, and at the outer edge of the ring of atmosphere, where rays get short. From near the
// ground the distance to the ground changes by a factor of a thousand in a degree.
ALPENGLOW_FN Real nadirAngleToU(IN(SkyViewParams) view, Real nadirAngle, bool hitsGround) {
  Real off = hitsGround ? view.horizon - nadirAngle : nadirAngle - view.horizon;
  Real whole = max(hitsGround ? view.horizon : view.span, REAL(1e-30));
  Real share = clamp(off / whole, REAL(0.0), REAL(1.0));
  Real root = sqrt(share);
  Real bend = hitsGround ? view.bend : skyRowBend();
  bool ring = !hitsGround && viewFromSpace(view);
  return ring ? root / (root + sqrt(REAL(1.0) - share)) : root * (REAL(1.0) + bend) / (root + bend);
}

ALPENGLOW_FN Real uToNadirAngle(IN(SkyViewParams) view, Real u, bool hitsGround) {
  Real bend = hitsGround ? view.bend : skyRowBend();
  Real root = u * bend / (REAL(1.0) + bend - u);
  bool ring = !hitsGround && viewFromSpace(view);
  Real rest = REAL(1.0) - u;
  Real share = ring ? u * u / (u * u + rest * rest) : root * root;
  return hitsGround ? view.horizon * (REAL(1.0) - share) : view.horizon + view.span * share;
}

// Texels of a table over directions: the sky-view LUT, or a layer of the aerial-perspective LUT.
struct DirectionGrid {
  Real groundRows;  // the sky's rows follow
  Real rows;
  Real columns;  // in use
  Real width;    // of the texture
};

// Grid of a sky-view LUT of columns x rows; the quality of its tables decides these.
ALPENGLOW_FN DirectionGrid skyViewGrid(IN(SkyViewParams) view, Real columns, Real rows) {
  DirectionGrid grid;
  grid.groundRows = floor(rows * (viewFromSpace(view) ? REAL(0.6) : REAL(0.3)));
  grid.rows = rows;
  grid.columns = azimuthColumns(view, columns);
  grid.width = columns * (ALPENGLOW_SPACE_VIEWS ? REAL(1.0) : REAL(0.5));
  return grid;
}

// Texture coordinate; sineHalf: sine of half the azimuth, even and smooth at both its ends as the light is.
ALPENGLOW_FN Real2 gridCoordinate(IN(DirectionGrid) grid, IN(SkyViewParams) view, Real nadirAngle,
                                  Real sineHalf, bool hitsGround) {
  Real u = nadirAngleToU(view, nadirAngle, hitsGround);
  Real texel = hitsGround ? u * (grid.groundRows - REAL(1.0))
                          : grid.groundRows + u * (grid.rows - grid.groundRows - REAL(1.0));
  return Real2((REAL(0.5) + sineHalf * (grid.columns - REAL(1.0))) / grid.width,
               (texel + REAL(0.5)) / grid.rows);
}

// The ray of texel (x, y), of a camera at an altitude.
ALPENGLOW_FN Ray gridRay(IN(Medium) m, IN(DirectionGrid) grid, IN(SkyViewParams) view, Real altitude, Real muS,
                         Real x, Real y) {
  bool hitsGround = y < grid.groundRows;
  Real u = hitsGround ? texelToU(y, grid.groundRows)
                      : texelToU(y - grid.groundRows, grid.rows - grid.groundRows);
  Real angle = uToNadirAngle(view, u, hitsGround);
  Real sineHalf = min(texelToU(x, grid.columns), REAL(1.0));
  Real mu = -cos(angle);
  Real sine = sin(angle);
  Real cosPhi = REAL(1.0) - REAL(2.0) * sineHalf * sineHalf;
  Real nu = clamp(mu * muS + sine * sqrt(max(REAL(1.0) - muS * muS, REAL(0.0))) * cosPhi, REAL(-1.0),
                  REAL(1.0));
  Ray ray = makeRay(m, altitude, mu, sine, muS, nu);
  // The row says on which side of the horizon a ray lies, despite rounding of its angle.
  ray.hitsGround = hitsGround;
  ray.extent =
      hitsGround ? distanceToGround(m, ray.h, ray.mu) : distanceToTop(m, ray.h, ray.mu);
  return ray;
}

// Angle between a direction and the nadir from its zenith cosine and from sin^2 of half that angle, which
// is precise near the nadir; otherwise arcCosine(-mu).
ALPENGLOW_FN Real angleFromNadir(Real mu, Real sineHalfSquared) {
  Real a = abs(mu);
  bool wide = a > REAL(0.5);
  Real half_ = mu < REAL(0.0) ? sineHalfSquared : REAL(0.5) * (REAL(1.0) - a);
  Real p = arcSineOfSmall(wide ? sqrt(max(half_, REAL(0.0))) : a);
  Real fromAxis = wide ? REAL(2.0) * p : REAL(0.5) * REAL(ALPENGLOW_PI) - p;
  return mu < REAL(0.0) ? fromAxis : REAL(ALPENGLOW_PI) - fromAxis;
}

// The angle of a direction from the nadir, and the sine of half its azimuth from the sun; `up` is the
// camera's vertical, `sunAzimuth` the horizontal unit vector towards the sun, or 0 for a sun in the zenith.
ALPENGLOW_FN Real2 skyViewAngles(Real3 up, Real3 sunAzimuth, Real3 direction) {
  Real mu = dot(direction, up);
  Real3 across = direction - mu * up;
  Real3 fromNadir = direction + up;
  Real cosine = dot(across, sunAzimuth) * inversesqrt(max(dot(across, across), REAL(1e-20)));
  return Real2(angleFromNadir(mu, REAL(0.25) * dot(fromNadir, fromNadir)),
               sqrt(clamp(REAL(0.5) - REAL(0.5) * cosine, REAL(0.0), REAL(1.0))));
}

// A texel keeps the logarithm of its light, because across the terminator light falls by more than a texel
// can follow; and apart, as a share of it, single Mie scattering without its phase function, which is too
// narrow for texels. The light that the logarithm is of has an even phase function in place of that.
ALPENGLOW_FN Real uniformPhase() { return REAL(0.25) / REAL(ALPENGLOW_PI); }

ALPENGLOW_FN void encodeSkyView(Spectrum smooth_, Spectrum mie, OUT(Spectrum) logarithm,
                                OUT(Spectrum) mieShare) {
  Spectrum light = smooth_;
  if (ALPENGLOW_MIE) light += mie * uniformPhase();
  light = max(light, SPECTRUM(kMinRadiance));
  logarithm = log(light);
  mieShare = ALPENGLOW_MIE ? mie / light : SPECTRUM(REAL(0.0));
}

ALPENGLOW_FN Spectrum decodeSkyView(Spectrum logarithm, Spectrum mieShare, Real miePhase_) {
  Spectrum light = exp(logarithm);
  if (ALPENGLOW_MIE)
    light *= max(SPECTRUM(REAL(1.0)) + mieShare * (miePhase_ - uniformPhase()), SPECTRUM(REAL(0.0)));
  return light;
}
