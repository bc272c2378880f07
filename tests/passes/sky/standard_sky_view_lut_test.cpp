// The sky-view LUT of the standard solver: the same picture as from the tables, and never a stale
// one.
#include <cmath>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr VkExtent2D kExtent = {48, 32};

class StandardSkyViewLutTest : public StandardSkyTest {
 protected:
  FrameState drawAt(double altitude, double elevation, double pitch = 5.0) {
    const Parameters earth = preset("earth");
    const EyeCamera camera = cameraFromGeodetic(earth, radians(20), radians(30), altitude,
                                                radians(80), radians(pitch), 0.0, radians(70));
    Vec sun;
    sunDirection(radians(20), radians(30), radians(elevation), radians(100), sun.data());
    FrameState draw = makeDraw(camera, sun, kExtent);
    draw.sun.discRadius = radians(0.2667);
    return draw;
  }

  View* standardLutView(MieStorage mie = MieStorage::Full) {
    return makeView({}, tables("earth", mie));
  }

  static void expectSame(const Picture& a, const Picture& b) {
    ASSERT_EQ(a.data.size(), b.data.size());
    for (size_t i = 0; i < a.data.size(); ++i)
      ASSERT_NEAR(a.data[i], b.data[i], 2e-5 * std::abs(b.data[i]) + 1e-9) << i / 4;
  }

  uint64_t dispatches() {
    ResourceReport report;
    resourceReport(context(), &report);
    return report.dispatches;
  }
};

// Interpolation in r and mu_s before or after that in mu and nu: only float rounding differs.
TEST_F(StandardSkyViewLutTest, GivesThePictureOfTheTables) {
  TargetDesc target;
  target.extent = kExtent;
  for (MieStorage mie : {MieStorage::Full, MieStorage::Packed}) {
    Tables* with = tables("earth", mie);
    View* direct = makeView(viewDesc(), with);
    View* fromLut = standardLutView(mie);
    for (double altitude : {0.0, 2.0, 9000.0, 59999.0, 60000.0}) {
      for (double elevation : {50.0, 3.0, -4.0}) {
        const FrameState draw = drawAt(altitude, elevation);
        recordViewLuts(fromLut, with, draw);
        expectSame(picture(fromLut, with, draw, target), picture(direct, with, draw, target));
      }
    }
  }
}

TEST_F(StandardSkyViewLutTest, IsNotReadForAnotherCameraSunOrTables) {
  TargetDesc target;
  target.extent = kExtent;
  Tables* earth = tables();
  Tables* mars = tables("mars");
  View* fromLut = standardLutView();
  View* direct = view();
  const FrameState draw = drawAt(2.0, 20.0);
  recordViewLuts(fromLut, earth, draw);
  for (const FrameState& other : {drawAt(3000.0, 20.0), drawAt(2.0, 5.0)})
    expectNeedsSlice(fromLut, earth, other);
  expectNeedsSlice(fromLut, tables("earth-hazy"), draw);
  // Above the atmosphere there is none, as for Mars, a smaller planet.
  expectSame(picture(fromLut, mars, draw, target), picture(direct, mars, draw, target));
  const FrameState space = drawAt(4e5, 20.0, -30.0);
  expectSame(picture(fromLut, earth, space, target), picture(direct, earth, space, target));
  // A turned head looks into the same LUT.
  const FrameState turned = drawAt(2.0, 20.0, -40.0);
  expectSame(picture(fromLut, earth, turned, target), picture(direct, earth, turned, target));
}

TEST_F(StandardSkyViewLutTest, IsOneDispatchInsideAndNoneOutside) {
  View* fromLut = standardLutView();
  uint64_t before = dispatches();
  recordViewLuts(fromLut, tables(), drawAt(2.0, 20.0));
  EXPECT_EQ(dispatches(), before + 1);
  before = dispatches();
  recordViewLuts(fromLut, tables(), drawAt(4e5, 20.0));
  EXPECT_EQ(dispatches(), before);
}

TEST_F(StandardSkyViewLutTest, RefusesTablesThatDoNotFit) {
  View* plain = view();
  View* fromLut = standardLutView();
  const FrameState draw = drawAt(2.0, 20.0);
  TableDesc other = smallTables();
  other.sizes.scatteringMu += 2;
  Tables* odd = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), other, &odd), Status::Ok);
  bakeAll(device(), odd);
  Tables* const packed = tables("earth", MieStorage::Packed);
  const uint64_t before = dispatches();
  run([&](VkCommandBuffer commands) {
    // A view without a LUT has nothing to record.
    EXPECT_EQ(testing::recordLuts(plain, commands, tables(), draw), Status::Ok);
    EXPECT_EQ(testing::recordLuts(fromLut, commands, odd, draw), Status::InvalidArgument);
    EXPECT_TRUE(hasAll(message(), "FrameDesc::tables|scatteringMu")) << message();
    EXPECT_EQ(testing::recordLuts(fromLut, commands, packed, draw), Status::InvalidArgument);
    EXPECT_TRUE(hasAll(message(), "FrameDesc::tables|MieStorage")) << message();
    return true;
  });
  EXPECT_EQ(dispatches(), before);
  destroyTables(odd);
}

}  // namespace
}  // namespace alpenglow::testing
