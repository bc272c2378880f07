// What effects cost, measured by what tables and frames cost without each: user CPU of lavapipe,
// all threads, the least of some after one that compiled the shaders.
#include <algorithm>
#include <cstdio>

#include "tests/bench/cpu_time.h"
#include "tests/passes/light_shafts/light_shaft_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr EffectFlags kRayleigh = effectBit(Effect::Rayleigh), kMie = effectBit(Effect::Mie),
                      kAbsorption = effectBit(Effect::Absorption),
                      kMultiple = effectBit(Effect::MultipleScattering),
                      kReflection = effectBit(Effect::GroundReflection),
                      kIrradiance = effectBit(Effect::GroundIrradiance),
                      kGroundAndDisc = effectBit(Effect::Ground) | effectBit(Effect::SunDisc),
                      kSpace = effectBit(Effect::SpaceViews);
constexpr VkExtent2D kExtent = {24, 16};

/// Tables and views without something, and what they have cost so far.
struct EffectCase {
  const char* name;
  EffectFlags disabledEffects = 0;
  bool settingsOfWhole = false;  ///< Else those that the atmosphere that is left calls for.
  Tables* tables = nullptr;
  View *sky = nullptr, *air = nullptr;
  double bake_s = 1e9, slice_s = 1e9, air_s = 1e9;
  double tableBytes = 0.0, bakeBytes = 0.0, lutBytes = 0.0, aerialPerspectiveBytes = 0.0;
};

TableSizes sizesOf(const Parameters& parameters, Quality quality) {
  TableDesc desc;
  desc.quality = quality;
  EXPECT_EQ(resolveTableDesc(parameters, &desc, {}), Status::Ok);
  return desc.sizes;
}

class EffectsBench : public LightShaftTest {
 protected:
  double bytes() {
    finishFrames(context());
    ResourceReport report;
    resourceReport(context(), &report);
    return double(report.bytes);
  }

  Tables* bakeOnce(EffectCase* each) {
    const double before = bytes();
    TableDesc desc;
    desc.disabledEffects = each->disabledEffects & kTableEffects;
    if (each->settingsOfWhole) desc.sizes = sizesOf(preset("earth"), desc.quality);
    Tables* tables = nullptr;
    EXPECT_EQ(createTables(context(), preset("earth"), desc, &tables), Status::Ok) << message();
    const double made = bytes();
    const double start = userSeconds();
    bakeAll(device(), tables);
    each->bake_s = std::min(each->bake_s, userSeconds() - start);
    each->tableBytes = bytes() - before;
    each->bakeBytes = made - before - each->tableBytes;
    return tables;
  }

  View* makeOne(Tables* tables, const ViewDesc& desc, double* taken) {
    const double before = bytes();
    View* view = makeView(desc, tables);
    *taken = bytes() - before;
    recordOnce(view, tables);
    return view;
  }

  /// The LUTs, of a frame that needs them anew.
  void recordOnce(View* view, const Tables* tables) {
    looking_.camera.position_m[0] += 0.01;
    FrameDesc frame = frameDesc(looking_, tables);
    frame.sceneDepth = rigOf(host_, kExtent).scene;
    run([&](VkCommandBuffer commands) {
      EXPECT_EQ(beginFrame(view, frame, nullptr), Status::Ok) << message();
      return alpenglow::recordLuts(view, commands) == Status::Ok;
    });
  }

  void make(EffectCase* each) {
    each->tables = bakeOnce(each);
    each->bake_s = 1e9;
    host_.shafts = false;
    ViewDesc desc = viewDesc();
    desc.sky = SkyMethod::Lut;
    desc.disabledEffects = each->disabledEffects | kGroundAndDisc;
    each->sky = makeOne(each->tables, desc, &each->lutBytes);
    desc.aerialPerspective = AerialPerspective::On;
    desc.sceneDepthFormat = host_.depthFormat;
    desc.depth = host_.depth;
    each->air = makeOne(each->tables, desc, &each->aerialPerspectiveBytes);
  }

  /// The kernel shares time out by its ticks, so a mean takes many of them.
  void luts(View* view, const Tables* tables, double* seconds) {
    const double start = userSeconds();
    int count = 0;
    for (; userSeconds() - start < 0.3; ++count) recordOnce(view, tables);
    *seconds = std::min(*seconds, (userSeconds() - start) / count);
  }

  FrameState looking_;
  LightShaftSetup host_;  ///< Its depth is stated with the frames.
};

// By turns, so that what else the machine does meets all alike.
TEST_F(EffectsBench, SavingsOfEachEffect) {
  looking_ = drawFrom({500, 0, 0}, 90, 50, 40, kExtent, 20, 140);
  std::vector<EffectCase> cases = {{"nothing"},
                                   {"rayleigh", kRayleigh},
                                   {"rayleigh, at the settings of the whole", kRayleigh, true},
                                   {"mie", kMie},
                                   {"absorption", kAbsorption},
                                   {"multiple_scattering", kMultiple},
                                   {"ground_reflection", kReflection},
                                   {"ground_irradiance", kIrradiance},
                                   {"both of the ground", kReflection | kIrradiance},
                                   {"space_views", kSpace}};
  for (EffectCase& each : cases) make(&each);
  for (int round = 0; round < 4; ++round) {
    for (EffectCase& each : cases) {
      if (round > 0) destroyTables(bakeOnce(&each));
      luts(each.sky, each.tables, &each.slice_s);
      luts(each.air, each.tables, &each.air_s);
    }
  }
  std::printf(
      "| without | bake cpu-s | tables MB | scratch MB | LUT cpu-ms | LUT MB | LUTs "
      "cpu-ms | LUTs MB |\n");
  for (const EffectCase& each : cases) {
    std::printf("| %s | %.2f | %.2f | %.2f | %.1f | %.2f | %.1f | %.1f |\n", each.name, each.bake_s,
                1e-6 * each.tableBytes, 1e-6 * each.bakeBytes, 1e3 * each.slice_s,
                1e-6 * each.lutBytes, 1e3 * each.air_s, 1e-6 * each.aerialPerspectiveBytes);
    destroyTables(each.tables);
  }
  const EffectCase &whole = cases[0], &clear = cases[3], &single = cases[5], &inside = cases[9];
  EXPECT_LT(cases[2].slice_s, whole.slice_s);
  EXPECT_LT(clear.bake_s, 0.7 * whole.bake_s);
  EXPECT_LT(clear.tableBytes, 0.5 * whole.tableBytes);
  EXPECT_LT(clear.slice_s, whole.slice_s);
  EXPECT_LT(single.bake_s, 0.1 * whole.bake_s);
  EXPECT_LT(single.slice_s, 0.7 * whole.slice_s);
  EXPECT_EQ(2.0 * inside.aerialPerspectiveBytes, whole.aerialPerspectiveBytes);
}

}  // namespace
}  // namespace alpenglow::testing
