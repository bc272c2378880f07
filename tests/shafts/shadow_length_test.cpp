// How much light shadows keep from a ray, against exact shadow intervals in double.
#include <cmath>
#include <cstdio>

#include "atmosphere/model/physics_cpp.h"
#include "tests/shafts/shaft_fixture.h"

namespace alpenglow::testing {
namespace {

using reference::Vector;

Vector vector(const Vec& v) { return {v[0], v[1], v[2]}; }

class ShadowTest : public ShaftTest {};

TEST_F(ShadowTest, Box) {
  addCaster(reference::test::box(Vector(1000, 3000, -200), Vector(1400, 3400, 200)));
  const SkyDraw d = drawFrom({50, 0, 0}, 90.0, 15.0, 60.0, {64, 48}, 40.0, 200.0);
  ShaftSetup setup;
  const ShaftPicture with = draw(setup, d);
  setup.shafts = false;
  const ShaftPicture without = draw(setup, d);
  const auto medium = makeMediumF64(parameters);
  int shadowed = 0, wrong = 0;
  for (uint32_t y = 0; y < 48; y += 2) {
    for (uint32_t x = 0; x < 64; x += 2) {
      const auto [o, v] = pixelRay(setup, d, x, y);
      const double loss = without.light.at(x, y)[1] - with.light.at(x, y)[1];
      const reference::SceneRay ray{vector(o), vector(v), vector(vec(d.sun.direction))};
      const auto hit = rays().closest(ray.position, ray.view, 1e-3, reference::kEndless);
      const double length = hit ? hit->t : 3e5;
      const auto shadow =
          reference::shadowIntervals(rays(), ray.position, ray.view, ray.sun, length);
      const auto lit = reference::litScattering(medium, ray, length, shadow, 1e-6);
      const auto whole = reference::litScattering(medium, ray, length, {}, 1e-6);
      const double want = whole.value[1] - lit.value[1];
      const double total = without.light.at(x, y)[1];
      if (!shadow.empty()) ++shadowed;
      if (std::abs(loss - want) > 0.003 * total) {
        ++wrong;
        if (wrong < 20)
          std::printf("%u %u: loss %g want %g of %g; shadows %zu hit %d sum %g\n", x, y, loss, want,
                      total, shadow.size(), hit ? 1 : 0, with.sums[4 * (y * 64 + x) + 3]);
      }
    }
  }
  std::printf("%d shadowed, %d wrong\n", shadowed, wrong);
}

}  // namespace
}  // namespace alpenglow::testing
