// What is decided for described scenes, without a device.
#include <alpenglow/plan.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "tests/parameters/heard.h"

namespace alpenglow {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

Plan planOf(const PlanRequest& request, const char* preset = "earth") {
  Parameters parameters;
  EXPECT_EQ(findPreset(preset, &parameters, {}), Status::Ok);
  Plan plan;
  testing::Heard heard;
  EXPECT_EQ(makePlan(parameters, request, &plan, heard.sink()), Status::Ok) << heard.sentence;
  return plan;
}

/// Of a request that is refused; `plan` must stay as it was.
std::string refusal(const PlanRequest& request) {
  Parameters parameters;
  EXPECT_EQ(findPreset("earth", &parameters, {}), Status::Ok);
  Plan plan;
  plan.imageCount = 77;
  testing::Heard heard;
  EXPECT_EQ(makePlan(parameters, request, &plan, heard.sink()), Status::InvalidArgument);
  EXPECT_EQ(heard.count, 1);
  EXPECT_EQ(plan.imageCount, 77u);
  return heard.sentence;
}

bool on(const Plan& plan, Effect effect) { return plan.choices[static_cast<uint32_t>(effect)].on; }

PlanRequest noon() {
  PlanRequest request;
  request.altitudeTo_m = 100.0;
  request.sunElevationFrom = 50.0 * kDegree;
  request.sunElevationTo = 60.0 * kDegree;
  request.visible = kVisibleSky | kVisibleGround;
  return request;
}

TEST(Plan, ClearNoonDisablesShaftsTwilightAndSpace) {
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
  PlanRequest request;
  request.altitudeTo_m = 2.0;
  request.sunElevationFrom = request.sunElevationTo = 3.0 * kDegree;
  request.sunFixed = true;
  request.visible = kVisibleSky | kVisibleGround | kVisibleSun;
  request.sunDiscRadius = 0.0047;
  request.tables.quality = Quality::Medium;
  const Plan plan = planOf(request);
  EXPECT_EQ(plan.tables.sizes.depthMu, 128u);
  EXPECT_LE(plan.cost.units, plan.whole.units / 4);
  uint64_t bytes = 0;
  for (uint32_t i = 0; i < plan.imageCount; ++i)
    if (std::string(plan.images[i].name).find("sky-view LUT") == std::string::npos)
      bytes += plan.images[i].bytes;
  constexpr uint64_t kDefaultTables = 7'000'000;  // docs/accuracy.md
  EXPECT_LE(bytes, kDefaultTables / 4);
  EXPECT_TRUE(plan.errorMet);
}

TEST(Plan, AnUnlimitedRequestEnablesEverything) {
  PlanRequest request;
  request.sunDiscRadius = 0.01;
  request.casters = true;
  const Plan plan = planOf(request);
  for (uint32_t i = 0; i < kEffectCount; ++i)
    EXPECT_TRUE(plan.choices[i].on) << plan.choices[i].reason;
  EXPECT_EQ(plan.tables.sunZenithTo, 0.0);
}

// A degree below the horizon of their greatest altitude, and of the top where that is not known.
TEST(Plan, CastersInThePlanetsShadowNeedNoLightShafts) {
  const auto shafts = [](double elevation, double casterAltitude_m) {
    PlanRequest request;
    request.altitudeTo_m = 3000.0;
    request.sunElevationFrom = request.sunElevationTo = elevation * kDegree;
    request.sunFixed = true;
    request.casters = true;
    request.casterAltitude_m = casterAltitude_m;
    const Plan plan = planOf(request);
    const PlanChoice& choice = plan.choices[static_cast<uint32_t>(Effect::LightShafts)];
    EXPECT_EQ(plan.view.lightShafts.method == LightShaftMethod::Off, !choice.on);
    const bool covered = std::string(choice.reason).find("shadow covers") != std::string::npos;
    EXPECT_EQ(covered, !choice.on) << choice.reason;
    return choice.on;
  };
  // 3 km high the horizon is 1.76 degrees low, for casters as for the ground in view.
  for (const double elevation : {10.0, 0.0, -2.0}) EXPECT_TRUE(shafts(elevation, 3000.0));
  for (const double elevation : {-5.0, -6.0, -12.0}) EXPECT_FALSE(shafts(elevation, 3000.0));
  EXPECT_TRUE(shafts(-6.0, 0.0));
  EXPECT_FALSE(shafts(-12.0, 0.0));
  // Those of a plan for lower casters are not enough for higher ones.
  PlanRequest low;
  low.altitudeTo_m = 1.0;
  low.sunElevationFrom = low.sunElevationTo = -2.2 * kDegree;
  low.sunFixed = low.casters = true;
  low.casterAltitude_m = 1000.0;
  PlanRequest high = low;
  high.casterAltitude_m = 2000.0;
  EXPECT_NE(comparePlans(planOf(low), planOf(high), {}), 0u);
  EXPECT_EQ(comparePlans(planOf(high), planOf(low), {}), 0u);
}

TEST(Plan, EffectsFollowTheMedium) {
  EXPECT_FALSE(on(planOf(noon(), "earth-clear"), Effect::Mie));
  EXPECT_FALSE(on(planOf(noon(), "earth-fig6"), Effect::Absorption));
  EXPECT_TRUE(on(planOf(noon(), "earth"), Effect::Absorption));
}

TEST(Plan, EveryReasonIsASentence) {
  const Plan plan = planOf(noon());
  ASSERT_GT(plan.choiceCount, kEffectCount + 3u);
  for (uint32_t i = 0; i < plan.choiceCount; ++i) {
    const PlanChoice& choice = plan.choices[i];
    const std::string reason = choice.reason;
    ASSERT_FALSE(reason.empty());
    EXPECT_EQ(reason.back(), '.') << reason;
    if (i >= kEffectCount) continue;
    EXPECT_STREQ(choice.name, effectName(static_cast<Effect>(i)));
    EXPECT_STREQ(choice.value, choice.on ? "on" : "off");
  }
}

TEST(Plan, WiderRequestsNeverGiveLess) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 60; ++i) {
    PlanRequest few;
    few.altitudeTo_m = 1.0 + 1e5 * unit(random);
    few.sunElevationFrom = (-60.0 + 120.0 * unit(random)) * kDegree;
    few.sunElevationTo = few.sunElevationFrom + 20.0 * unit(random) * kDegree;
    few.visible = 1 + static_cast<VisibilityFlags>(30.0 * unit(random));
    few.errorTarget = 0.05;
    PlanRequest more = few;
    more.altitudeTo_m *= 1.0 + unit(random);
    more.sunElevationFrom -= 10.0 * unit(random) * kDegree;
    more.visible |= kVisibleGround;
    more.errorTarget = 0.05 * (0.1 + 0.9 * unit(random));
    const Plan a = planOf(few), b = planOf(more);
    for (uint32_t e = 0; e < kEffectCount; ++e)
      EXPECT_LE(a.choices[e].on, b.choices[e].on) << i << b.choices[e].reason;
    EXPECT_LE(a.tables.quality, b.tables.quality) << i;
    EXPECT_LE(a.cost.bytes, b.cost.bytes) << i;
  }
}

RecreateFlags change(const Plan& current, const PlanRequest& request, std::string* reason) {
  testing::Heard heard;
  const RecreateFlags flags = comparePlans(current, planOf(request), heard.sink());
  EXPECT_EQ(heard.count, flags != 0 ? 1 : 0) << heard.sentence;
  EXPECT_EQ(heard.severity, Severity::Info);
  *reason = heard.sentence;
  return flags;
}

TEST(Plan, CoversItsOwnRequest) {
  const Plan plan = planOf(noon());
  std::string reason;
  PlanRequest request = noon();
  request.sunElevationFrom = 52.0 * kDegree;
  request.altitudeTo_m = 50.0;
  EXPECT_EQ(change(plan, request, &reason), 0u) << reason;
  request.sunElevationFrom = -5.0 * kDegree;
  EXPECT_NE(change(plan, request, &reason) & kRecreateTables, 0u);
  EXPECT_NE(reason, "");
}

TEST(Plan, ReportsWhatChangesRecreate) {
  const Plan plan = planOf(noon());
  std::string reason;
  const struct {
    const char* name;
    void (*change)(PlanRequest*);
    RecreateFlags expected;
  } cases[] = {
      {"nothing", [](PlanRequest*) {}, 0},
      {"solver", [](PlanRequest* r) { r->tables.solver = Solver::Standard; },
       kRecreateTables | kRecreateView},
      {"format", [](PlanRequest* r) { r->tables.format = TableFormat::Float; }, kRecreateTables},
      {"sizes", [](PlanRequest* r) { r->tables.sizes.nodesR = 20; }, kRecreateTables},
      {"quality", [](PlanRequest* r) { r->tables.quality = Quality::Ultra; },
       kRecreateTables | kRecreateView},
      {"projection", [](PlanRequest* r) { r->view.projection = Projection::Fisheye; },
       kRecreateView},
      {"scene", [](PlanRequest* r) { r->visible |= kVisibleScene; }, kRecreateView},
      {"casters",
       [](PlanRequest* r) {
         r->visible |= kVisibleScene;
         r->casters = true;
       },
       kRecreateView},
      {"disc",
       [](PlanRequest* r) {
         r->visible |= kVisibleSun;
         r->sunDiscRadius = 0.005;
       },
       kRecreateView},
      {"an effect by hand", [](PlanRequest* r) { r->effects[uint32_t(Effect::Mie)] = Force::Off; },
       kRecreateTables | kRecreateView},
      {"budget", [](PlanRequest* r) { r->budgetBytes = uint64_t{1} << 40; }, 0},
  };
  for (const auto& c : cases) {
    PlanRequest request = noon();
    c.change(&request);
    EXPECT_EQ(change(plan, request, &reason), c.expected) << c.name << ": " << reason;
  }
}

TEST(Plan, RefusesWrongRequests) {
  PlanRequest request;
  request.altitudeFrom_m = -1.0;
  const std::string message = refusal(request);
  EXPECT_NE(message.find("altitudeFrom_m is -1"), std::string::npos) << message;
}

// By the sentence that createTables has, and before any order costs memory.
TEST(Plan, RefusesTablesThatCanNotBeMade) {
  const struct {
    const char* part;
    void (*spoil)(TableDesc*);
  } cases[] = {
      {"orders is 10000000", [](TableDesc* d) { d->orders = 10'000'000; }},
      {"orders is 10000000",
       [](TableDesc* d) {
         d->solver = Solver::Standard;
         d->orders = 10'000'000;
       }},
      {"nodesR is 100000", [](TableDesc* d) { d->sizes.nodesR = 100'000; }},
      {"stepCount", [](TableDesc* d) { d->sizes.stepCount = 5; }},
      {"scatteringMu is 3",
       [](TableDesc* d) {
         d->solver = Solver::Standard;
         d->sizes.scatteringMu = 3;
       }},
      {"transmittanceMu is 4294967295",
       [](TableDesc* d) {
         d->solver = Solver::Standard;
         d->sizes.transmittanceMu = ~0u;
       }},
      {"azimuths is 2", [](TableDesc* d) { d->sizes.azimuths = 2; }},
      {"solver 9", [](TableDesc* d) { d->solver = static_cast<Solver>(9); }},
      {"sunZenithFrom is 2 and sunZenithTo 1",
       [](TableDesc* d) { d->sunZenithFrom = 2.0, d->sunZenithTo = 1.0; }},
  };
  for (const auto& c : cases) {
    PlanRequest request = noon();
    c.spoil(&request.tables);
    const std::string message = refusal(request);
    EXPECT_NE(message.find(c.part), std::string::npos) << message;
  }
}

TEST(Plan, ExpectsTheSecondsOfABake) {
  PlanRequest request = noon();
  request.secondsPerUnit = 1e-6;
  const Plan plan = planOf(request);
  EXPECT_DOUBLE_EQ(plan.expectedBakeSeconds, 1e-6 * double(plan.cost.units));
  EXPECT_TRUE(plan.budgetMet);
  request.budgetSeconds = 1e-3;
  EXPECT_FALSE(planOf(request).budgetMet);
  EXPECT_GT(planOf(noon()).expectedBakeSeconds, 0.0);
}

}  // namespace
}  // namespace alpenglow
