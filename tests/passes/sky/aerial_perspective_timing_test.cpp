// What an aerial-perspective LUT costs to fill, and to look into: user CPU over submit and wait,
// all threads.
#include <cstdio>

#include "tests/passes/sky/aerial_perspective_fixture.h"

namespace alpenglow::testing {
namespace {

class AerialPerspectiveTimingTest : public AerialPerspectiveTest {};

TEST_F(AerialPerspectiveTimingTest, LutUpdateAndLookups) {
  for (const double altitude : {2.0, 1e4, 4e5}) {
    double sun[3];
    sunDirection(0.0, 0.0, radians(30.0), 0.2, sun);
    const double pitch = altitude > 1e5 ? radians(-40.0) : 0.0;
    const FrameState draw = makeDraw(
        cameraFromGeodetic(preset("earth"), 0.0, 0.0, altitude, 0.3, pitch, 0.0, radians(60.0)),
        vec(sun), {256, 256});
    // As neighbours in a picture of terrain: distances by the row.
    std::vector<AerialQuery> queries;
    for (uint32_t y = 0; y < 256; ++y) {
      for (uint32_t x = 0; x < 256; ++x) {
        const Vec v = *pixelDirection(draw, Projection::Perspective, x, y);
        queries.push_back(
            {{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])},
             200.0f * static_cast<float>(1 + y) + static_cast<float>(x)});
      }
    }
    const double filled = fillSeconds(draw);
    const double each = 1e9 / double(queries.size());
    const double nothing = each * askSeconds(draw, AerialAsk::Nothing, queries);
    const double light = each * askSeconds(draw, AerialAsk::Light, queries) - nothing;
    const double single = each * askSeconds(draw, AerialAsk::SingleAlone, queries) - nothing;
    const double path = each * askSeconds(draw, AerialAsk::All, queries);
    std::printf(
        "aerial-perspective LUT, %8.0f m: filled in %.1f cpu-ms; a lookup %.1f ns, single alone "
        "%.1f ns "
        "(beside a ray's set-up, %.1f ns; the integral it is tested with %.0f ns)\n",
        altitude, 1e3 * filled, light, single, nothing, path);
    EXPECT_LT(light, 0.1 * path);
    EXPECT_LT(single, 0.1 * path);
  }
}

}  // namespace
}  // namespace alpenglow::testing
