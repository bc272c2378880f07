// Light shafts from low suns to deep dusk: no step in the picture, and nothing is drawn once the
// planet's own shadow covers all casters.
#include <algorithm>
#include <cmath>

#include "atmosphere/passes/light_shaft_frame.h"
#include "tests/passes/light_shafts/shadow_check.h"

namespace alpenglow::testing {
namespace {

using reference::Vector;
using reference::test::box;

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr LightShaftMethod kMethods[] = {
    LightShaftMethod::LightVolume, LightShaftMethod::ShadowVolume, LightShaftMethod::RayMarch};

TEST(SunReaches, TheCastersUntilThePlanetsShadowCoversThem) {
  const Parameters earth = preset("earth");
  // Six kilometres high: the horizon lies acos(Rg / (Rg + h)) below the horizontal there.
  const double rg = earth.bottomRadius_m;
  PlanetBox bounds;
  bounds.center_m[0] = rg + 3000.0;
  bounds.halfAxes_m[0][0] = 3000.0;
  bounds.halfAxes_m[1][1] = bounds.halfAxes_m[2][2] = 1.0;
  const double dip = std::acos(rg / (rg + 6000.0));
  const auto reached = [&](double elevation, const Parameters& p) {
    const double sun[3] = {std::sin(elevation), std::cos(elevation), 0.0};
    return passes::sunReaches(p, bounds, sun);
  };
  for (const double elevation : {1.5, 0.5, 0.0, -0.02}) EXPECT_TRUE(reached(elevation, earth));
  EXPECT_TRUE(reached(-dip + 1e-4, earth));
  EXPECT_FALSE(reached(-dip - 1e-4, earth));
  EXPECT_FALSE(reached(-0.5, earth));
  EXPECT_FALSE(reached(-1.57, earth));
  // A soft sun reaches over the horizon by its radius.
  Parameters soft = earth;
  soft.sunAngularRadius = 0.5 * kDegree;
  EXPECT_TRUE(reached(-dip - 0.4 * kDegree, soft));
  EXPECT_FALSE(reached(-dip - 0.6 * kDegree, soft));
  // A box without extent is a point; one about the planet's centre reaches out of the shadow.
  for (auto& axis : bounds.halfAxes_m) std::fill_n(axis, 3, 0.0);
  EXPECT_TRUE(reached(0.0, earth));
  EXPECT_FALSE(reached(-dip, earth));
  std::fill_n(bounds.center_m, 3, 0.0);
  for (int i = 0; i < 3; ++i) bounds.halfAxes_m[i][i] = 2.0 * rg;
  EXPECT_TRUE(reached(-1.0, earth));
}

class LightShaftDuskTest : public ShadowCheckTest {
 protected:
  // Ridges of up to six kilometres between the camera and the sun, and opposite it.
  void SetUp() override {
    ShadowCheckTest::SetUp();
    addCaster(box(Vector(-100, 9e3, -6e3), Vector(3000, 12e3, 2e3)));
    addCaster(box(Vector(-100, 20e3, 1e3), Vector(6000, 22e3, 3e3)));
    addCaster(box(Vector(-100, -14e3, -3e3), Vector(4500, -11e3, 5e3)));
  }
  LightShaftSetup setupOf(LightShaftMethod method) const {
    LightShaftSetup setup;
    setup.method = method;
    setup.shadowMapSize = 256;
    setup.multipleLoss = 0.0;  // The default.
    return setup;
  }
  void expectNoStep(LightShaftMethod method, double heading);
  /// Looks towards the sun (east) or away from it.
  FrameState from(double heading, double elevation) {
    return drawFrom({2900, 0, 0}, heading, 2, 70, kExtent, elevation, 90);
  }
};

/// Tenths of a degree, falling. In the default tests every one about the suns at which the casters'
/// tops and feet enter the planet's shadow, and each tenth elsewhere; every one in the long tests.
std::vector<int> suns() {
  std::vector<int> tenths;
  for (int sun = 50; sun >= -120; --sun) {
#ifdef ALPENGLOW_ALL_METHODS
    tenths.push_back(sun);
#else
    if ((sun <= -9 && sun >= -28) || sun % 10 == 0) tenths.push_back(sun);
#endif
  }
  return tenths;
}

// Share of light that is left in each pixel, from sun to sun.
void LightShaftDuskTest::expectNoStep(LightShaftMethod method, double heading) {
  std::vector<double> before;
  int last = 0;
  for (const int sun : suns()) {
    LightShaftPicture with, unshadowed;
    losses(setupOf(method), from(heading, 0.1 * sun), &with, &unshadowed);
    std::vector<double> left;
    for (size_t i = 0; i < with.light.data.size(); i += 4) {
      for (size_t c = 0; c < 3; ++c) {
        const double whole = std::max(double(unshadowed.light.data[i + c]), 1e-12);
        left.push_back(with.light.data[i + c] / whole);
      }
    }
    // Edges of shadows move from sun to sun: the mean shows a step of a whole region, the quantile
    // one of many pixels. Light itself halves from sun to sun where its last rays graze the ground.
    double mean = 0.0;
    std::vector<double> steps;
    for (size_t i = 0; i < before.size(); ++i) {
      ASSERT_TRUE(std::isfinite(left[i]) && left[i] >= 0.0 && left[i] <= 1.0001) << left[i];
      steps.push_back(std::abs(left[i] - before[i]));
      mean += steps.back() / double(before.size());
    }
    const double tenths = last - sun;
    if (!steps.empty()) {
      const auto most = steps.begin() + static_cast<long>(steps.size() * 95 / 100);
      std::nth_element(steps.begin(), most, steps.end());
      EXPECT_LT(mean, 0.04 * tenths) << int(method) << ", heading " << heading << ", sun " << sun;
      EXPECT_LT(*most, 0.35 * tenths) << int(method) << ", heading " << heading << ", sun " << sun;
    }
    before = left;
    last = sun;
  }
}

TEST_F(LightShaftDuskTest, NoStepTowardsTheSun) {
  expectNoStep(LightShaftMethod::LightVolume, 90.0);
}
TEST_F(LightShaftDuskTest, NoStepOppositeTheSun) {
  expectNoStep(LightShaftMethod::LightVolume, 270.0);
}
TEST_F(LightShaftDuskTest, NoStepOfOtherMethods) {
  expectNoStep(LightShaftMethod::RayMarch, 270.0);
  expectNoStep(LightShaftMethod::ShadowVolume, 270.0);
}

TEST_F(LightShaftDuskTest, CastersInThePlanetsShadowCastNone) {
  for (const LightShaftMethod method : kMethods) {
    for (const double elevation : {-3.0, -6.0, -12.0}) {
      LightShaftPicture with, unshadowed;
      ResourceReport start, end;
      losses(setupOf(method), from(270, elevation), &with, &unshadowed);  // Makes what it needs.
      resourceReport(context(), &start);
      for (const double loss : losses(setupOf(method), from(90, elevation), &with, &unshadowed))
        EXPECT_EQ(loss, 0.0);
      resourceReport(context(), &end);
      EXPECT_EQ(end.shadowMapUpdates, start.shadowMapUpdates);
      // Aerial perspective and sky of both pictures.
      EXPECT_LE(end.draws - start.draws, 6u) << int(method) << elevation;
      double sum = 0.0;
      for (size_t i = 1; i < with.light.data.size(); i += 4) sum += with.light.data[i];
      EXPECT_GT(sum, 0.0);
    }
  }
}

}  // namespace
}  // namespace alpenglow::testing
