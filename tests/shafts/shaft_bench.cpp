// What light shafts cost over the real terrain, and how far they are from exact shadows: each method,
// each scene. `build/bin/shaft_bench`.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "atmosphere/model/physics_cpp.h"
#include "tests/shafts/real_terrain.h"

namespace alpenglow::testing {
namespace {

using reference::Vector;


class ShaftBench : public ShaftTest {};

struct View3 {
  const char* name;
  double east, north, above, heading, pitch, fov, sunElevation, sunAzimuth;
};
constexpr View3 kViews[] = {
    {"valley, sun 8 deg ahead", -2000, -4000, 60, 80, 4, 60, 8, 70},
    {"summit, sun 5 deg aside", 3000, 2000, 400, 300, -6, 60, 5, 220},
    {"summit, sun 25 deg ahead", 3000, 2000, 400, 200, -8, 60, 25, 190},
    {"from 30 km, sun 10 deg", -20000, -20000, 30000, 45, -45, 60, 10, 90},
};

TEST_F(ShaftBench, Cost) {
  addCaster(realTerrain(parameters));
  const char* size = std::getenv("ALPENGLOW_BENCH_WIDTH");
  const uint32_t width = size != nullptr ? static_cast<uint32_t>(std::atoi(size)) : 1024;
  std::printf("ms of user CPU at %u x %u\n", width, width * 3 / 4);
  for (const View3& v : kViews) {
    const double ground = terrainAltitude(rays(), parameters, v.east, v.north);
    const SkyDraw d = drawFrom({ground + v.above, v.east, v.north}, v.heading, v.pitch, v.fov,
                               {width, width * 3 / 4}, v.sunElevation, v.sunAzimuth);
    std::printf("%s\n", v.name);
    for (int method = -1; method < 3; ++method) {
      ShaftSetup setup;
      setup.shafts = method >= 0;
      setup.method = static_cast<ShaftMethod>(std::max(method, 0));
      setup.sunMapSize = 2048;
      setup.passes = 2;
      const ShaftPicture p = draw(setup, d);
      const ShaftSeconds& s = p.seconds;
      const char* names[] = {"off", "exact", "paper", "march"};
      double layers = 0.0;
      if (method == 0)
        for (size_t i = 3; i < p.sums.size(); i += 4) layers += std::abs(p.sums[i]);
      std::printf("  %-6s depth %6.1f slice %6.1f sun map %6.1f shafts %6.1f air %6.1f\n",
                  names[method + 1], 1e3 * s.depth, 1e3 * s.slice, 1e3 * s.sunMap, 1e3 * s.shafts,
                  1e3 * s.air);
    }
  }
}

}  // namespace
}  // namespace alpenglow::testing
