// What light shafts cost over the real terrain, for each method: `build/bin/light_shaft_bench`.
#include <cstdio>

#include "tests/passes/light_shafts/terrain_views.h"

namespace alpenglow::testing {
namespace {

class LightShaftBench : public TerrainLightShaftTest {};

TEST_F(LightShaftBench, UserCpuOfEachStep) {
  constexpr VkExtent2D kSize = {1024, 768};
  std::printf("ms of user CPU at %u x %u\n", kSize.width, kSize.height);
  for (const TerrainView& v : kTerrainViews) {
    const FrameState d = drawOf(v, kSize);
    std::printf("%s\n", v.name);
    for (uint32_t method = 0; method < 4; ++method) {
      LightShaftSetup setup;
      setup.method = static_cast<LightShaftMethod>(method);
      setup.shafts = setup.method != LightShaftMethod::Off;
      setup.shadowMapSize = 2048;
      setup.closed = true;
      setup.multipleLoss = 0.0;
      setup.passes = 2;
      const LightShaftSeconds s = draw(setup, d).seconds;
      EXPECT_GT(s.air, 0.0);
      const char* names[] = {"off", "light volume", "shadow volume", "march 32"};
      std::printf(
          "  %-13s depth %6.1f LUTs %6.1f shadow map %6.1f shafts %6.1f air and sky %6.1f\n",
          names[method], 1e3 * s.depth, 1e3 * s.luts, 1e3 * s.shadowMap, 1e3 * s.shafts,
          1e3 * s.air);
    }
  }
}

}  // namespace
}  // namespace alpenglow::testing
