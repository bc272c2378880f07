// Rays in a shell in long double: its 64 bits of mantissa bear the cancellations of the plain
// formulas for distances. Only differences of squared radii are taken apart, as exact products.
#pragma once

#include <algorithm>
#include <cmath>

namespace alpenglow::test {

using Long = long double;

struct ExactRay {
  Long bottom, h, mu;

  Long r() const { return bottom + h; }
  Long rho2() const { return h * (2 * bottom + h); }
  Long delta() const { return r() * r() * mu * mu - rho2(); }
  bool hitsGround() const { return mu < 0 && delta() > 0; }
  Long toGround() const { return -r() * mu - std::sqrt(std::max(delta(), Long(0))); }
  Long toTop(Long thickness) const {
    const Long gap2 = (thickness - h) * (2 * bottom + thickness + h);
    return -r() * mu + std::sqrt(std::max(r() * r() * mu * mu + gap2, Long(0)));
  }
  Long altitudeAt(Long t) const { return std::sqrt(r() * r() + t * t + 2 * r() * mu * t) - bottom; }
};

}  // namespace alpenglow::test
