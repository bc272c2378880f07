// What is decided for described scenes, without a device.
#include <alpenglow/plan.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

namespace alpenglow {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

Plan planOf(const Needs& needs, const char* preset = "earth", const TableDesc& base = {}) {
  Parameters parameters;
  EXPECT_EQ(findPreset(preset, &parameters), Status::Ok);
  Plan plan;
  char message[320] = "";
  EXPECT_EQ(makePlan(parameters, needs, base, &plan, message, sizeof message), Status::Ok)
      << message;
  return plan;
}

bool on(const Plan& plan, Effect effect) { return plan.effects[static_cast<uint32_t>(effect)].on; }

Needs noon() {
  Needs needs;
  needs.altitudeTo_m = 100.0;
  needs.sunElevationFrom = 50.0 * kDegree;
  needs.sunElevationTo = 60.0 * kDegree;
  needs.seen = kSeenSky | kSeenGround;
  return needs;
}

TEST(Plan, ClearNoonHasNothingOfShaftsTwilightOrSpace) {
  const Plan plan = planOf(noon());
  for (const Effect off : {Effect::LightShafts, Effect::Twilight, Effect::Night, Effect::SpaceViews,
                           Effect::AerialPerspective, Effect::SunDisc})
    EXPECT_FALSE(on(plan, off)) << effectName(off);
  EXPECT_LT(plan.cost.bytes, plan.whole.bytes / 4);
  EXPECT_TRUE(plan.errorMet);
}

// The goal of a scene at ground level under a fixed evening sun, by the numbers of the plan; what
// it measures and how far it is from the truth: build/bin/domain_bench.
TEST(Plan, AFixedEveningSunTakesAQuarter) {
  Needs needs;
  needs.altitudeTo_m = 2.0;
  needs.sunElevationFrom = needs.sunElevationTo = 3.0 * kDegree;
  needs.sunFixed = true;
  needs.seen = kSeenSky | kSeenGround | kSeenSun;
  needs.sunDiscRadius = 0.0047;
  TableDesc medium;
  medium.quality = Quality::Medium;
  const Plan plan = planOf(needs, "earth", medium);
  EXPECT_EQ(plan.tableDesc.sizes.depthMu, 128u);
  EXPECT_LE(plan.cost.units, plan.whole.units / 4);
  uint64_t tables = 0;
  for (uint32_t i = 0; i < plan.tableCount; ++i)
    if (std::string(plan.tables[i].name).find("sky slice") == std::string::npos)
      tables += plan.tables[i].bytes;
  constexpr uint64_t kDefaultTables = 7'000'000;  // docs/accuracy.md
  EXPECT_LE(tables, kDefaultTables / 4);
  EXPECT_TRUE(plan.errorMet);
}

TEST(Plan, AnythingHasEverything) {
  Needs needs;
  needs.sunDiscRadius = 0.01;
  needs.occluders = true;
  const Plan plan = planOf(needs);
  for (uint32_t i = 0; i < kEffectCount; ++i)
    EXPECT_TRUE(plan.effects[i].on) << plan.effects[i].reason;
  EXPECT_EQ(plan.tableDesc.sunZenithTo, 0.0);
}

TEST(Plan, AirDecides) {
  EXPECT_FALSE(on(planOf(noon(), "earth-clear"), Effect::Mie));
  EXPECT_FALSE(on(planOf(noon(), "earth-fig6"), Effect::Absorption));
  EXPECT_TRUE(on(planOf(noon(), "earth"), Effect::Absorption));
}

TEST(Plan, EveryReasonIsASentence) {
  const Plan plan = planOf(noon());
  for (const EffectChoice& choice : plan.effects) {
    const std::string reason = choice.reason;
    ASSERT_FALSE(reason.empty());
    EXPECT_EQ(reason.back(), '.') << reason;
  }
  ASSERT_GT(plan.choiceCount, 3u);
  for (uint32_t i = 0; i < plan.choiceCount; ++i)
    EXPECT_EQ(std::string(plan.choices[i].reason).back(), '.') << plan.choices[i].reason;
}

TEST(Plan, MoreNeedsNeverGiveLess) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    Needs few;
    few.altitudeTo_m = 1.0 + 1e5 * unit(random);
    few.sunElevationFrom = (-60.0 + 120.0 * unit(random)) * kDegree;
    few.sunElevationTo = few.sunElevationFrom + 20.0 * unit(random) * kDegree;
    few.seen = 1 + static_cast<SeenFlags>(30.0 * unit(random));
    few.error = 0.05;
    Needs more = few;
    more.altitudeTo_m *= 1.0 + unit(random);
    more.sunElevationFrom -= 10.0 * unit(random) * kDegree;
    more.seen |= kSeenGround;
    more.error = 0.05 * (0.1 + 0.9 * unit(random));
    const Plan a = planOf(few), b = planOf(more);
    for (uint32_t e = 0; e < kEffectCount; ++e)
      EXPECT_LE(a.effects[e].on, b.effects[e].on) << i << b.effects[e].reason;
    EXPECT_LE(a.tableDesc.quality, b.tableDesc.quality) << i;
    EXPECT_LE(a.cost.bytes, b.cost.bytes) << i;
  }
}

TEST(Plan, ServesWhatItWasMadeFor) {
  const Plan plan = planOf(noon());
  char reason[256];
  Needs needs = noon();
  needs.sunElevationFrom = 52.0 * kDegree;
  needs.altitudeTo_m = 50.0;
  EXPECT_TRUE(planServes(plan, needs, reason, sizeof reason)) << reason;
  PlanChange change = comparePlans(plan, planOf(needs));
  EXPECT_FALSE(change.tables || change.view || change.shafts) << change.reason;
  needs.sunElevationFrom = -5.0 * kDegree;
  EXPECT_FALSE(planServes(plan, needs, reason, sizeof reason));
  EXPECT_NE(std::string(reason), "");
  change = comparePlans(plan, planOf(needs));
  EXPECT_TRUE(change.tables);
  EXPECT_NE(std::string(change.reason), "");
}

TEST(Plan, RefusesWrongNeeds) {
  Parameters parameters;
  ASSERT_EQ(findPreset("earth", &parameters), Status::Ok);
  Needs needs;
  needs.altitudeFrom_m = -1.0;
  Plan plan;
  char message[320] = "";
  EXPECT_EQ(makePlan(parameters, needs, {}, &plan, message, sizeof message),
            Status::InvalidArgument);
  EXPECT_NE(std::string(message).find("altitudeFrom_m is -1"), std::string::npos) << message;
}

}  // namespace
}  // namespace alpenglow
