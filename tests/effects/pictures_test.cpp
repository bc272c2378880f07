// Disabled effects don't change the rest: light and pictures without effects.
#include <cmath>
#include <cstdio>

#include "atmosphere/tables/table_set.h"
#include "tests/passes/sky/sky_fixture.h"
#include "tests/tables/bake_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr EffectFlags kMie = effectBit(Effect::Mie);
constexpr EffectFlags kMultiple = effectBit(Effect::MultipleScattering);
constexpr EffectFlags kReflection = effectBit(Effect::GroundReflection);
constexpr EffectFlags kIrradiance = effectBit(Effect::GroundIrradiance);

class EffectsTest : public SkyTest {
 protected:
  ResourceReport report() {
    ResourceReport now;
    resourceReport(context(), &now);
    return now;
  }

  TableDesc desc(EffectFlags disabledEffects) {
    TableDesc desc;
    desc.sizes = kTinySettings;
    desc.disabledEffects = disabledEffects;
    return desc;
  }

  Tables* bake(const Parameters& parameters, EffectFlags disabledEffects) {
    Tables* made = nullptr;
    EXPECT_EQ(createTables(context(), parameters, desc(disabledEffects), &made), Status::Ok)
        << message();
    if (made != nullptr) bakeAll(device(), made);
    return made;
  }

  static std::vector<ProbeQuery> queries() {
    std::vector<ProbeQuery> result;
    for (double sun : {20.0, 75.0, 92.0}) {
      for (double view : {10.0, 80.0, 100.0}) {
        ProbeQuery query;
        query.altitude_m = 1500.0;
        query.zenith = radians(view);
        query.sunZenith = radians(sun);
        query.azimuth = radians(35.0);
        result.push_back(query);
      }
    }
    return result;
  }

  /// The greatest relative difference of the light that both see.
  double difference(Tables* a, Tables* b) {
    const std::vector<ProbeAnswer> first = probeAll(queries(), a), second = probeAll(queries(), b);
    EXPECT_EQ(first.size(), queries().size());
    EXPECT_EQ(second.size(), queries().size());
    double most = 0.0;
    for (size_t i = 0; i < first.size() && i < second.size(); ++i) {
      for (uint32_t c = 0; c < kSpectrumSize; ++c) {
        const double x = first[i].skyRadiance[c], y = second[i].skyRadiance[c];
        EXPECT_GT(x, 0.0);
        most = std::max(most, std::abs(x - y) / std::max(x, 1e-30));
      }
    }
    return most;
  }

  void compare(const Parameters& parameters, EffectFlags disabledEffects, double error) {
    Tables* whole = bake(parameters, 0);
    Tables* part = bake(parameters, disabledEffects);
    ASSERT_TRUE(whole != nullptr && part != nullptr);
    const double most = difference(whole, part);
    std::printf("without 0x%02x: %.1e\n", disabledEffects, most);
    EXPECT_LE(most, error) << disabledEffects;
    destroyTables(whole);
    destroyTables(part);
  }
};

TEST_F(EffectsTest, AbsentConstituentsCostNothing) {
  Parameters bare = preset("earth");
  bare.absorption.present = false;
  compare(bare, effectBit(Effect::Absorption), 1e-6);
  Parameters black = preset("earth");
  black.groundAlbedo = Spectrum{};
  compare(black, kReflection, 1e-5);
  compare(preset("earth"), kIrradiance, 0.0);
  Parameters clear = preset("earth");
  clear.mie.present = false;
  compare(clear, kMie, 1e-5);
  Parameters dusty = preset("earth");
  dusty.rayleigh.present = false;
  compare(dusty, effectBit(Effect::Rayleigh), 1e-6);
}

TEST_F(EffectsTest, PersistentImagesMatchEnabledEffects) {
  const struct {
    EffectFlags disabledEffects;
    uint64_t images;
  } cases[] = {{0, 3}, {kMie, 2}, {kMultiple, 1}, {kMie | kMultiple, 1}, {kReflection, 3}};
  finishFrames(context());  // What earlier tests destroyed goes.
  for (const auto& each : cases) {
    const ResourceReport before = report();
    Tables* made = bake(preset("earth"), each.disabledEffects);
    ASSERT_NE(made, nullptr);
    finishFrames(context());
    EXPECT_EQ(report().images - before.images, each.images) << each.disabledEffects;
    const bool multiple = (each.disabledEffects & kMultiple) == 0;
    EXPECT_EQ(imageOf(made, kTableMoments).name != nullptr, multiple);
    const bool source = multiple && (each.disabledEffects & kMie) == 0;
    EXPECT_EQ(imageOf(made, kTableSource).name != nullptr, source);
    EXPECT_FALSE(probeAll(queries(), made).empty());
    destroyTables(made);
    finishFrames(context());
    EXPECT_EQ(report().images, before.images);
  }
}

TEST_F(EffectsTest, SkyIsUnchangedByDisabledViewEffects) {
  const EyeCamera camera =
      cameraFromGeodetic(preset("earth"), 0.8, 0.2, 500.0, 1.0, radians(50.0), 0.0, radians(40.0));
  Vec sun;
  sunDirection(0.8, 0.2, radians(20.0), radians(190.0), sun.data());
  const FrameState draw = makeDraw(camera, sun, {48, 32});
  for (const bool fromLut : {false, true}) {
    ViewDesc desc = viewDesc();
    desc.sky = fromLut ? SkyMethod::Lut : SkyMethod::Integrate;
    View* const whole = makeView(desc);
    desc.disabledEffects = kViewEffects;
    View* const part = makeView(desc);
    if (fromLut) recordViewLuts(whole, tables(), draw);
    const Picture a = picture(whole, tables(), draw);
    if (fromLut) recordViewLuts(part, tables(), draw);
    EXPECT_EQ(a.data, picture(part, tables(), draw).data);
  }
}

}  // namespace
}  // namespace alpenglow::testing
