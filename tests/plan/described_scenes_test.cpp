// What is decided for scenes as an engine would describe them.
#include <alpenglow/plan.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/parameters/heard.h"

namespace alpenglow {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr VisibilityFlags kOutside = kVisibleSky | kVisibleGround | kVisibleSun;

struct Described {
  const char* name;
  const char* air;
  double altitudeTo_m;    ///< 0: no limit.
  double sunFrom, sunTo;  ///< Degrees.
  VisibilityFlags visible;
  bool occluders;
  double error;    ///< 0: the default.
  const char* on;  ///< Effects that must be on, and such that must be off.
  const char* off;
};

constexpr Described kScenes[] = {
    {"racing game at noon", "earth", 50, 40, 60, kOutside | kVisibleScene, false, 0,
     "ground sun_disc aerial_perspective mie", "twilight night space_views light_shafts"},
    {"forest at noon", "earth", 50, 40, 60, kVisibleSky | kVisibleScene, true, 0,
     "light_shafts aerial_perspective ground_irradiance", "ground sun_disc twilight"},
    {"evening on a hill", "earth", 500, 1, 8, kOutside, false, 0, "sun_disc ground", "night"},
    {"sunset to dusk", "earth", 500, -10, 5, kOutside, false, 0, "twilight sun_disc", "night"},
    {"dusk alone", "earth", 10, -11, -7, kOutside, false, 0, "twilight", "night light_shafts"},
    {"a whole day", "earth", 100, -90, 90, kOutside, false, 0, "twilight night sun_disc",
     "space_views light_shafts"},
    {"night alone", "earth", 10, -60, -30, kVisibleSky, false, 0, "night", "ground sun_disc"},
    {"airliner", "earth", 12000, 20, 40, kOutside, false, 0, "ground", "space_views twilight"},
    {"balloon at the edge", "earth", 59000, 20, 40, kOutside, false, 0, "ground", "space_views"},
    {"space station", "earth", 400000, -90, 90, kOutside | kVisibleSpace, false, 0,
     "space_views twilight night", "aerial_perspective"},
    {"ground to orbit", "earth", 0, -90, 90, kOutside | kVisibleSpace | kVisibleScene, true, 0,
     "space_views light_shafts aerial_perspective", ""},
    {"sky dome for a menu", "earth", 2, 30, 30.1, kVisibleSky, false, 0, "multiple_scattering",
     "ground sun_disc ground_irradiance aerial_perspective"},
    {"clear desert", "earth-clear", 100, 40, 60, kOutside, false, 0, "rayleigh absorption", "mie"},
    {"the paper's figure", "earth-fig6", 100, 10, 60, kOutside, false, 0, "mie rayleigh",
     "absorption"},
    {"smog", "earth-hazy", 100, 10, 60, kOutside | kVisibleScene, true, 0, "mie light_shafts", ""},
    {"Mars at noon", "mars", 100, 40, 60, kOutside, false, 0, "mie ground", "absorption twilight"},
    {"Mars at dusk", "mars", 100, -10, 2, kOutside, false, 0, "twilight mie", "absorption"},
    {"mobile, coarse", "earth", 50, 20, 60, kOutside, false, 0.05, "multiple_scattering",
     "twilight"},
    {"film, fine", "earth", 50, 20, 60, kOutside, false, 0.0045, "multiple_scattering", "twilight"},
    {"indoors with windows", "earth", 20, 10, 50, kVisibleSky | kVisibleScene, true, 0,
     "light_shafts ground_irradiance", "ground sun_disc"},
    {"caves without casters", "earth", 20, 10, 50, kVisibleSky | kVisibleScene, false, 0,
     "aerial_perspective", "light_shafts"},
    {"set sun, with casters", "earth", 20, -12, -9, kOutside | kVisibleScene, true, 0,
     "aerial_perspective", "light_shafts"},
};
static_assert(std::size(kScenes) >= 20);

Plan planOf(const Described& scene) {
  Parameters parameters;
  EXPECT_EQ(findPreset(scene.air, &parameters, {}), Status::Ok);
  PlanRequest request;
  request.altitudeTo_m = scene.altitudeTo_m;
  request.sunElevationFrom = scene.sunFrom * kDegree;
  request.sunElevationTo = scene.sunTo * kDegree;
  request.visible = scene.visible;
  request.casters = scene.occluders;
  request.errorTarget = scene.error;
  request.sunDiscRadius = (scene.visible & kVisibleSun) != 0 ? 0.0047 : 0.0;
  Plan plan;
  testing::Heard heard;
  EXPECT_EQ(makePlan(parameters, request, &plan, heard.sink()), Status::Ok) << heard.sentence;
  return plan;
}

/// Effects named in a text, one after the other.
bool names(const std::string& text, const std::string& name) {
  return (" " + text + " ").find(" " + name + " ") != std::string::npos;
}

TEST(DescribedScenes, EnableExactlyTheEffectsTheyNeed) {
  for (const Described& scene : kScenes) {
    const Plan plan = planOf(scene);
    for (uint32_t i = 0; i < kEffectCount; ++i) {
      const char* name = effectName(static_cast<Effect>(i));
      const PlanChoice& choice = plan.choices[i];
      if (names(scene.on, name) || names(scene.off, name)) {
        EXPECT_EQ(choice.on, names(scene.on, name)) << scene.name << ": " << choice.reason;
      }
      const std::string reason = choice.reason;
      ASSERT_FALSE(reason.empty()) << scene.name << " " << name;
      EXPECT_EQ(reason.back(), '.') << scene.name << " " << name;
    }
    EXPECT_LE(plan.cost.bytes, plan.whole.bytes) << scene.name;
    EXPECT_LE(plan.cost.units, plan.whole.units) << scene.name;
  }
}

TEST(DescribedScenes, FinerErrorsTakeFinerLevels) {
  const auto level = [](const char* name) {
    for (const Described& scene : kScenes)
      if (std::string(scene.name) == name) return planOf(scene).tables.quality;
    return Quality::Default;
  };
  EXPECT_EQ(level("mobile, coarse"), Quality::Draft);
  EXPECT_GT(level("film, fine"), level("mobile, coarse"));
}

}  // namespace
}  // namespace alpenglow
