// CPU and device give the same answers from tables with disabled effects.
#include <alpenglow/query.h>

#include <cmath>
#include <cstdio>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr EffectFlags kMie = effectBit(Effect::Mie),
                      kMultiple = effectBit(Effect::MultipleScattering),
                      kReflection = effectBit(Effect::GroundReflection),
                      kIrradiance = effectBit(Effect::GroundIrradiance);

/// Below a starlit night.
constexpr double kFloor = 1e-9;

class EffectQueryTest : public SkyTest {
 protected:
  /// From the ground to space, by day and twilight; every fifth an irradiance.
  static std::vector<ProbeQuery> queries() {
    std::vector<ProbeQuery> result;
    for (const double altitude : {0.0, 1500.0, 2e5}) {
      for (const double sun : {20.0, 75.0, 93.0}) {
        for (const double view : {10.0, 85.0, 100.0, 150.0, -1.0}) {
          ProbeQuery query;
          query.altitude_m = altitude;
          query.kind = view < 0.0 ? QueryKind::Irradiance : QueryKind::Ray;
          query.zenith = radians(std::max(view, 0.0));
          query.sunZenith = radians(sun);
          query.azimuth = view < 0.0 ? 0.0 : radians(35.0);
          result.push_back(query);
        }
      }
    }
    return result;
  }

  static void expectSame(const Spectrum& device, const Spectrum& cpu, double* most) {
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      *most = std::max(*most, std::abs(cpu[c] - device[c]) / std::max(device[c], kFloor));
    }
  }
};

TEST_F(EffectQueryTest, TheCpuAnswersWhatTheDeviceAnswers) {
  const std::vector<ProbeQuery> asked = queries();
  const auto count = static_cast<uint32_t>(asked.size());
  for (const EffectFlags disabledEffects :
       {kMie, kMultiple, kMie | kMultiple, kIrradiance, kIrradiance | kReflection,
        kTableEffects & ~kMultiple}) {
    TableDesc desc;
    desc.quality = Quality::Draft;
    desc.cpuQueries = CpuQueries::All;
    desc.disabledEffects = disabledEffects;
    // Something must be there to scatter.
    if ((disabledEffects & effectBit(Effect::Rayleigh)) != 0)
      desc.disabledEffects &= ~effectBit(Effect::Rayleigh);
    Tables* tables = nullptr;
    ASSERT_EQ(createTables(context(), preset("earth"), desc, &tables), Status::Ok) << message();
    bakeAll(device(), tables);
    const bool multiple = hasEffect(disabledEffects, Effect::MultipleScattering);
    const auto has = [&](TableId id) { return imageOf(tables, id).name != nullptr; };
    EXPECT_TRUE(has(kTableOpticalDepth));
    EXPECT_EQ(has(kTableMoments), multiple) << disabledEffects;
    EXPECT_EQ(has(kTableSource), multiple && hasEffect(disabledEffects, Effect::Mie))
        << disabledEffects;
    const uint64_t next = device().skipFrame();
    ASSERT_EQ(advanceFrame(context(), next, next - 1), Status::Ok) << message();
    const std::vector<ProbeAnswer> device = probeAll(asked, tables);
    std::vector<ProbeAnswer> cpu(asked.size());
    ASSERT_EQ(answerQueries(tables, asked.data(), count, nullptr, cpu.data()), Status::Ok)
        << message();
    double most = 0.0, light = 0.0, sky = 0.0;
    for (size_t i = 0; i < asked.size(); ++i) {
      ASSERT_EQ(cpu[i].hitsGround, device[i].hitsGround) << i;
      light = std::max(light, device[i].skyRadiance[1]);
      sky = std::max(sky, device[i].sky[1]);
      expectSame(device[i].transmittance, cpu[i].transmittance, &most);
      expectSame(device[i].skyRadiance, cpu[i].skyRadiance, &most);
      expectSame(device[i].groundRadiance, cpu[i].groundRadiance, &most);
      expectSame(device[i].direct, cpu[i].direct, &most);
      expectSame(device[i].sky, cpu[i].sky, &most);
    }
    std::printf("without 0x%02x: %.1e\n", desc.disabledEffects, most);
    EXPECT_LT(most, 5e-5) << disabledEffects;
    EXPECT_GT(light, 0.0) << disabledEffects;
    // E of the sky is there if it was baked.
    EXPECT_EQ(sky > 0.0, multiple && hasEffect(disabledEffects, Effect::GroundIrradiance))
        << disabledEffects;
    destroyTables(tables);
  }
}

}  // namespace
}  // namespace alpenglow::testing
