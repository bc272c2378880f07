// The sky slice of the standard solver: the same picture as from the tables, and never a stale one.
#include <cmath>

#include "tests/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr VkExtent2D kExtent = {48, 32};

class StandardSliceTest : public StandardSkyTest {
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

  View* sliceView(MieStorage mie = MieStorage::Full) { return makeView({}, tables("earth", mie)); }

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
TEST_F(StandardSliceTest, GivesThePictureOfTheTables) {
  TargetDesc target;
  target.extent = kExtent;
  for (MieStorage mie : {MieStorage::Full, MieStorage::Packed}) {
    Tables* with = tables("earth", mie);
    View* direct = makeView(viewDesc(), with);
    View* sliced = sliceView(mie);
    for (double altitude : {0.0, 2.0, 9000.0, 59999.0, 60000.0}) {
      for (double elevation : {50.0, 3.0, -4.0}) {
        const FrameState draw = drawAt(altitude, elevation);
        recordSlice(sliced, with, draw);
        expectSame(picture(sliced, with, draw, target), picture(direct, with, draw, target));
      }
    }
  }
}

TEST_F(StandardSliceTest, IsNotReadForAnotherCameraSunOrTables) {
  TargetDesc target;
  target.extent = kExtent;
  Tables* earth = tables();
  Tables* mars = tables("mars");
  View* sliced = sliceView();
  View* direct = view();
  const FrameState draw = drawAt(2.0, 20.0);
  recordSlice(sliced, earth, draw);
  for (const FrameState& other : {drawAt(3000.0, 20.0), drawAt(2.0, 5.0)})
    expectNeedsSlice(sliced, earth, other);
  expectNeedsSlice(sliced, tables("earth-hazy"), draw);
  // Above the air there is none, as for Mars, a smaller planet.
  expectSame(picture(sliced, mars, draw, target), picture(direct, mars, draw, target));
  const FrameState space = drawAt(4e5, 20.0, -30.0);
  expectSame(picture(sliced, earth, space, target), picture(direct, earth, space, target));
  // A turned head looks into the same slice.
  const FrameState turned = drawAt(2.0, 20.0, -40.0);
  expectSame(picture(sliced, earth, turned, target), picture(direct, earth, turned, target));
}

TEST_F(StandardSliceTest, IsOneDispatchInsideAndNoneOutside) {
  View* sliced = sliceView();
  uint64_t before = dispatches();
  recordSlice(sliced, tables(), drawAt(2.0, 20.0));
  EXPECT_EQ(dispatches(), before + 1);
  before = dispatches();
  recordSlice(sliced, tables(), drawAt(4e5, 20.0));
  EXPECT_EQ(dispatches(), before);
}

TEST_F(StandardSliceTest, RefusesTablesThatDoNotFit) {
  View* plain = view();
  View* sliced = sliceView();
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
    EXPECT_EQ(testing::recordLuts(sliced, commands, odd, draw), Status::InvalidArgument);
    EXPECT_TRUE(hasAll(message(), "FrameDesc::tables|scatteringMu")) << message();
    EXPECT_EQ(testing::recordLuts(sliced, commands, packed, draw), Status::InvalidArgument);
    EXPECT_TRUE(hasAll(message(), "FrameDesc::tables|MieStorage")) << message();
    return true;
  });
  EXPECT_EQ(dispatches(), before);
  destroyTables(odd);
}

}  // namespace
}  // namespace alpenglow::testing
