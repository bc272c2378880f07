// What light shafts cost over the real terrain, for each method: `build/bin/shaft_bench`.
#include <cstdio>

#include "tests/shafts/terrain_views.h"

namespace alpenglow::testing {
namespace {

class ShaftBench : public TerrainShaftTest {};

TEST_F(ShaftBench, UserCpuOfEachStep) {
  constexpr VkExtent2D kSize = {1024, 768};
  std::printf("ms of user CPU at %u x %u\n", kSize.width, kSize.height);
  for (const TerrainView& v : kTerrainViews) {
    const SkyDraw d = drawOf(v, kSize);
    std::printf("%s\n", v.name);
    for (int method = -1; method < 3; ++method) {
      ShaftSetup setup;
      setup.shafts = method >= 0;
      setup.method = static_cast<ShaftMethod>(std::max(method, 0));
      setup.sunMapSize = 2048;
      setup.closed = true;
      setup.multipleLoss = 0.0;
      setup.passes = 2;
      const ShaftSeconds s = draw(setup, d).seconds;
      EXPECT_GT(s.air, 0.0);
      const char* names[] = {"off", "exact", "paper", "march 32"};
      std::printf("  %-8s depth %6.1f slice %6.1f sun map %6.1f shafts %6.1f air and sky %6.1f\n",
                  names[method + 1], 1e3 * s.depth, 1e3 * s.slice, 1e3 * s.sunMap, 1e3 * s.shafts,
                  1e3 * s.air);
    }
  }
}

}  // namespace
}  // namespace alpenglow::testing
