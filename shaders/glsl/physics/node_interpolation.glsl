// Pass "I n" of the moment solver: the table of moments between the nodes, by cubics, so that the sampler's
// linear interpolation of it costs no accuracy. The includer defines
//   Spectrum fetchNode(int x, int y)   a layer of a node, encoded

// Slope at the second of three equally spaced values, by their distance: central, but limited so that a
// cubic through them does not overshoot where light ends between two nodes.
ALPENGLOW_FN Spectrum limitedSlope(Spectrum before, Spectrum here, Spectrum after) {
  Spectrum a = here - before;
  Spectrum b = after - here;
  return REAL(0.5) * (sign(a) + sign(b)) *
         min(abs(REAL(0.5) * (a + b)), REAL(3.0) * min(abs(a), abs(b)));
}

// Hermite's cubic between the two values in the middle.
ALPENGLOW_FN Spectrum cubic(Spectrum before, Spectrum a, Spectrum b, Spectrum after, Real t) {
  Spectrum slopeA = limitedSlope(before, a, b);
  Spectrum slopeB = limitedSlope(a, b, after);
  Spectrum rise = b - a;
  return a + t * (slopeA + t * (REAL(3.0) * rise - REAL(2.0) * slopeA - slopeB +
                                t * (slopeA + slopeB - REAL(2.0) * rise)));
}

// What lies beyond the first and the last of a row of values: a parabola goes on through three of them, a
// line through two.
ALPENGLOW_FN Spectrum beyond(Spectrum end, Spectrum next, Spectrum third, bool line) {
  return line ? REAL(2.0) * end - next : REAL(3.0) * (end - next) + third;
}

// Along mu_s at altitude node y.
ALPENGLOW_FN Spectrum cubicAlongMuS(int lower, int last, Real t, int y) {
  Spectrum a = fetchNode(lower, y);
  Spectrum b = fetchNode(lower + 1, y);
  Spectrum before = fetchNode(max(lower - 1, 0), y);
  Spectrum after = fetchNode(min(lower + 2, last), y);
  Spectrum first = lower > 0 ? before : beyond(a, b, after, last == 1);
  Spectrum fourth = lower + 1 < last ? after : beyond(b, a, before, last == 1);
  return cubic(first, a, b, fourth, t);
}

// Texel (x, y) of one layer, whose first row of nodes is `first`.
ALPENGLOW_FN Spectrum interpolatedNode(IN(MomentShape) s, int x, int y, int first) {
  int lastX = int(s.nodesMuS) - 1;
  int lastY = int(s.nodesR) - 1;
  int stepX = (int(s.fieldMuS) - 1) / lastX;
  int stepY = (int(s.fieldR) - 1) / lastY;
  int lowerX = min(x / stepX, lastX - 1);
  int lowerY = min(y / stepY, lastY - 1);
  Real t = Real(x - lowerX * stepX) / Real(stepX);
  Spectrum a = cubicAlongMuS(lowerX, lastX, t, first + lowerY);
  Spectrum b = cubicAlongMuS(lowerX, lastX, t, first + lowerY + 1);
  Spectrum before = cubicAlongMuS(lowerX, lastX, t, first + max(lowerY - 1, 0));
  Spectrum after = cubicAlongMuS(lowerX, lastX, t, first + min(lowerY + 2, lastY));
  before = lowerY > 0 ? before : beyond(a, b, after, lastY == 1);
  after = lowerY + 1 < lastY ? after : beyond(b, a, before, lastY == 1);
  return cubic(before, a, b, after, Real(y - lowerY * stepY) / Real(stepY));
}
