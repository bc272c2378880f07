// Views of the real terrain that costs and errors are measured in.
#pragma once

#include "tests/passes/light_shafts/real_terrain.h"

namespace alpenglow::testing {

/// Angles in degrees; `above` metres over the ground.
struct TerrainView {
  const char* name;
  double east, north, above, heading, pitch, sunElevation, sunAzimuth;
};
inline constexpr TerrainView kTerrainViews[] = {
    {"valley, sun 8 deg ahead", -2000, -4000, 60, 80, 4, 8, 70},
    {"summit, sun 5 deg aside", 3000, 2000, 400, 300, -6, 5, 220},
    {"summit, sun 25 deg ahead", 3000, 2000, 400, 200, -8, 25, 190},
    {"from 30 km, sun 10 deg", -20000, -20000, 30000, 45, -45, 10, 90},
};

/// LightShaftTest over the real terrain, with tables of the default quality.
class TerrainLightShaftTest : public LightShaftTest {
 protected:
  void SetUp() override {
    LightShaftTest::SetUp();
    ASSERT_EQ(createTables(context(), parameters, TableDesc{}, &baked), Status::Ok) << message();
    bakeAll(device(), baked);
    addCaster(realTerrain(parameters));
  }
  void TearDown() override {
    destroyTables(baked);
    LightShaftTest::TearDown();
  }
  FrameState drawOf(const TerrainView& v, VkExtent2D size) {
    const double ground = terrainAltitude(rays(), parameters, v.east, v.north);
    return drawFrom({ground + v.above, v.east, v.north}, v.heading, v.pitch, 60.0, size,
                    v.sunElevation, v.sunAzimuth);
  }
};

}  // namespace alpenglow::testing
