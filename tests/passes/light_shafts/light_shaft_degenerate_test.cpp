// Casters that have no clear silhouette, or none at all: nothing may be out of bounds.
#include <cmath>

#include "tests/passes/light_shafts/shadow_check.h"

namespace alpenglow::testing {
namespace {

using reference::Vector;
using reference::test::box;
using reference::test::Mesh;

class LightShaftDegenerateTest : public ShadowCheckTest {
 protected:
  /// All methods: finite, not negative, and no brighter than without light shafts; pixels of
  /// LightVolume lie in none or one shadow.
  void expectSane(const FrameState& d, bool closed = true) {
    for (const LightShaftMethod method :
         {LightShaftMethod::LightVolume, LightShaftMethod::ShadowVolume,
          LightShaftMethod::RayMarch}) {
      SCOPED_TRACE(static_cast<int>(method));
      LightShaftSetup setup;
      setup.method = method;
      setup.shadowMapSize = 256;
      LightShaftPicture with, unshadowed;
      losses(setup, d, &with, &unshadowed);
      EXPECT_EQ(badValue(with.light), "");
      int brighter = 0;
      for (size_t i = 0; i < with.light.data.size(); ++i)
        brighter += with.light.data[i] > unshadowed.light.data[i] * 1.00001f + 1e-7f ? 1 : 0;
      EXPECT_EQ(brighter, 0);
      if (method == LightShaftMethod::LightVolume) expectCounts(with);
      if (method == LightShaftMethod::ShadowVolume && closed) {
        setup.hostDepth = false;
        const LightShaftPicture open = draw(setup, d);
        int uncancelled = 0;
        for (size_t i = 0; i < open.sums.size(); i += 2) uncancelled += open.sums[i] != 0.0f;
        EXPECT_EQ(uncancelled, 0);
      }
    }
  }
  /// The camera is in shadow, or not, for all pixels alike.
  void expectCounts(const LightShaftPicture& picture) {
    float least = 0.0f, most = 0.0f;
    for (size_t i = 3; i < picture.sums.size(); i += 4) {
      EXPECT_EQ(picture.sums[i], std::round(picture.sums[i]));
      least = std::min(least, picture.sums[i]);
      most = std::max(most, picture.sums[i]);
    }
    EXPECT_LE(most - least, 1.0f);
  }
  ShadowScene over(std::vector<Mesh> casters, double sunElevation, double sunAzimuth) {
    return {"", std::move(casters), {50, 0, 0}, 90, 12, 60, sunElevation, sunAzimuth};
  }
};

const Mesh kBlock = box(Vector(600, 1500, -200), Vector(900, 1800, 200));

TEST_F(LightShaftDegenerateTest, FacesAlongTheBeam) {
  // Along each axis of the box: four of its faces are edge-on.
  for (const auto& [elevation, azimuth] :
       {std::pair(90.0, 0.0), std::pair(0.0, 0.0), std::pair(0.0, 90.0), std::pair(0.0, 270.0)}) {
    SCOPED_TRACE(elevation);
    SCOPED_TRACE(azimuth);
    expectSane(stage(over({kBlock}, elevation, azimuth)));
  }
}

TEST_F(LightShaftDegenerateTest, CornersOnTheNearPlane) {
  FrameState d = stage(over({box(Vector(45, 10, -6), Vector(48, 20, -1)), kBlock}, 30, 200));
  d = drawFrom({50, 0, 0}, 90.0, 0.0, 60.0, kExtent, 30.0, 200.0);
  d.depth.near_m = 10.0;
  expectSane(d);
}

TEST_F(LightShaftDegenerateTest, TrianglesWithoutArea) {
  Mesh mesh = kBlock;
  mesh.indices.insert(mesh.indices.end(), {0, 0, 1, 2, 2, 2});
  // Three corners on a line, at three places.
  const Vector a(650, 1500, 0);
  for (int i = 0; i < 3; ++i) mesh.indices.push_back(addCorner(mesh, a + Vector(20.0 * i, 0, 0)));
  expectSane(stage(over({mesh}, 35, 200)), false);
}

TEST_F(LightShaftDegenerateTest, CastersSmallerThanATexel) {
  const Mesh grain = box(Vector(80, 100, 0), Vector(80.2, 100.2, 0.2));
  const FrameState d = stage(over({kBlock, grain}, 35, 200));
  LightShaftSetup setup;
  setup.shadowMapSize = 256;
  EXPECT_GT(texel(setup, d), 1.0);
  expectSane(d);
}

TEST_F(LightShaftDegenerateTest, ASheetHasNoThickness) {
  Mesh sheet;
  for (const Vector& p : {Vector(700, 1500, -200), Vector(700, 1800, -200), Vector(700, 1800, 200),
                          Vector(700, 1500, 200)})
    addCorner(sheet, p);
  sheet.indices = {0, 1, 2, 0, 2, 3};
  // From above, from below the horizontal, and edge-on.
  for (const double elevation : {90.0, 40.0, 0.0})
    expectSane(stage(over({sheet}, elevation, 180)), false);
  // It does cast a shadow.
  const FrameState d = stage(over({sheet}, 40, 180));
  LightShaftSetup setup;
  setup.shadowMapSize = 256;
  LightShaftPicture with, unshadowed;
  double sum = 0.0;
  for (const double loss : losses(setup, d, &with, &unshadowed)) sum += loss;
  EXPECT_GT(sum, 1e-3);
}

TEST_F(LightShaftDegenerateTest, NothingCastsNoShadow) {
  const FrameState d = stage(over({kBlock}, 35, 200));
  drawNothing = true;
  for (const LightShaftMethod method :
       {LightShaftMethod::LightVolume, LightShaftMethod::ShadowVolume,
        LightShaftMethod::RayMarch}) {
    LightShaftSetup setup;
    setup.method = method;
    setup.shadowMapSize = 256;
    setup.hostDepth = false;
    LightShaftPicture with, unshadowed;
    for (const double loss : losses(setup, d, &with, &unshadowed)) EXPECT_EQ(loss, 0.0);
  }
}

}  // namespace
}  // namespace alpenglow::testing
