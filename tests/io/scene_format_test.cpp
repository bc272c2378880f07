// What formatScene writes, parseScene reads back.
#include <alpenglow/io/atmosphere_file.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <set>

#include "random_scene.h"
#include "scene_compare.h"
#include "schema.h"
#include "temporary_folder.h"

#include "tests/parameters/heard.h"

namespace alpenglow::io {
namespace {

using test::Angles;
using test::expectSentence;
using test::randomScene;
using test::sceneDifference;
using test::TemporaryFolder;

std::string schemaError(const std::string& text) {
  return test::schemaError(ALPENGLOW_SCHEMA_FOLDER, "scene.schema.json",
                           nlohmann::json::parse(text));
}

Scene parsed(const std::string& text) {
  const Result<Scene> scene = parseScene(text, "s.json", "/");
  EXPECT_TRUE(scene) << scene.error << "\n" << text;
  return scene ? *scene : Scene{};
}

Scene earthScene() {
  return parsed(R"({"atmosphere": "earth", "sun": {"elevation_deg": 5}, "camera": {}})");
}

std::string normal(const std::string& path) {
  return path.empty() ? path : std::filesystem::absolute(path).lexically_normal().string();
}

Scene withNormalPaths(Scene scene) {
  scene.albedoMap = normal(scene.albedoMap);
  if (scene.terrain) {
    scene.terrain->heightMap = normal(scene.terrain->heightMap);
    scene.terrain->albedoMap = normal(scene.terrain->albedoMap);
  }
  return scene;
}

TEST(SceneFormat, EverySampleSceneComesBack) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ALPENGLOW_SCENE_FOLDER)) {
    if (entry.path().extension() != ".json") continue;
    ++count;
    const Result<Scene> scene = readScene(entry.path().string());
    ASSERT_TRUE(scene) << scene.error;
    const std::string text = formatScene(*scene);
    const Scene again = parsed(text);
    EXPECT_EQ(sceneDifference(again, withNormalPaths(*scene)), "") << text;
    EXPECT_EQ(schemaError(text), "") << text;
    EXPECT_EQ(formatScene(again), text);
    EXPECT_EQ(text.find(".."), std::string::npos) << text;
    EXPECT_NE(text.find("\"atmosphere\": \"earth"), std::string::npos) << text;
  }
  EXPECT_GT(count, 5);
}

TEST(SceneFormat, RandomScenesComeBackBitForBit) {
  std::mt19937_64 random(20);
  for (int i = 0; i < 600; ++i) {
    const Scene scene = randomScene(&random, Angles::OfDegrees);
    const std::string text = formatScene(scene);
    const Scene again = parsed(text);
    ASSERT_EQ(sceneDifference(again, scene), "") << i << "\n" << text;
    ASSERT_EQ(schemaError(text), "") << i << "\n" << text;
    ASSERT_EQ(formatScene(again), text) << i;
  }
}

// Degrees give about ten in eleven doubles of radians, and each of the others' neighbours.
TEST(SceneFormat, AnyAngleComesBackAsItOrItsNeighbourAndStays) {
  std::mt19937_64 random(21);
  int exact = 0;
  const int count = 600;
  for (int i = 0; i < count; ++i) {
    const Scene scene = randomScene(&random, Angles::OfRadians);
    const std::string text = formatScene(scene);
    const Scene again = parsed(text);
    ASSERT_EQ(sceneDifference(again, scene, 1), "") << i << "\n" << text;
    ASSERT_EQ(schemaError(text), "") << i << "\n" << text;
    ASSERT_EQ(formatScene(again), text) << i;
    ASSERT_EQ(sceneDifference(parsed(formatScene(again)), again), "") << i;
    exact += sceneDifference(again, scene).empty() ? 1 : 0;
  }
  EXPECT_LT(exact, count);  // Else the sentence in the header is too modest.
}

TEST(SceneFormat, AnglesAtTheirBoundsStayInside) {
  constexpr double kPi = 3.14159265358979323846;
  for (const double sign : {1.0, -1.0}) {
    Scene scene = earthScene();
    scene.sun.elevation = scene.camera.latitude = scene.camera.pitch = sign * kPi / 2;
    scene.sun.discRadius = kPi / 4;
    scene.camera.projection = Projection::Fisheye;
    scene.camera.fov = 2 * kPi;
    EXPECT_EQ(sceneDifference(parsed(formatScene(scene)), scene), "");
    scene.sun.elevation = std::nextafter(scene.sun.elevation, 0.0);
    EXPECT_EQ(sceneDifference(parsed(formatScene(scene)), scene, 1), "");
  }
}

TEST(SceneFormat, ReadsWell) {
  Scene scene = earthScene();
  scene.width = 640;
  scene.exposure = 2.5;
  EXPECT_EQ(formatScene(scene), R"({
  "atmosphere": "earth",
  "sun": {"elevation_deg": 5.0, "azimuth_deg": 0.0, "disc_radius_deg": 0.2667},
  "camera": {
    "latitude_deg": 0.0,
    "longitude_deg": 0.0,
    "altitude_m": 2.0,
    "heading_deg": 0.0,
    "pitch_deg": 0.0,
    "roll_deg": 0.0,
    "projection": "perspective",
    "fov_deg": 60.0
  },
  "size": [640, 768],
  "exposure": 2.5
}
)");
}

TEST(SceneFormat, AnAtmosphereIsAPresetsNameOnlyIfAllBitsAreThePresets) {
  const auto atmosphere = [](const Scene& scene) {
    return nlohmann::json::parse(formatScene(scene))["atmosphere"];
  };
  Scene scene = earthScene();
  for (const Preset& listed : testing::allPresets()) {
    Parameters preset;
    ASSERT_EQ(findPreset(listed.name, &preset, {}), Status::Ok);
    scene.atmosphere = preset;
    EXPECT_EQ(atmosphere(scene), listed.name);
    for (double Parameters::*field : {&Parameters::topRadius_m, &Parameters::sunAngularRadius}) {
      for (const double towards : {-1e9, 1e9}) {
        scene.atmosphere = preset;
        scene.atmosphere.*field = std::nextafter(preset.*field, towards);
        EXPECT_TRUE(atmosphere(scene).is_object()) << listed.name;
      }
    }
  }
}

TEST(SceneFormat, ALoneEndOfARangeHasTheScenesOwnAtTheOther) {
  Scene scene = earthScene();
  scene.requirements.emplace();
  scene.requirements->altitude_m[1] = 500.0;
  scene.requirements->sunElevation[0] = 0.0;
  const Scene again = parsed(formatScene(scene));
  ASSERT_TRUE(again.requirements.has_value());
  EXPECT_EQ(again.requirements->altitude_m[0], 2.0);
  EXPECT_EQ(again.requirements->altitude_m[1], 500.0);
  EXPECT_EQ(again.requirements->sunElevation[0], 0.0);
  EXPECT_EQ(again.requirements->sunElevation[1], scene.sun.elevation);
}

TEST(SceneFormat, WritesFilesThatCanBeReadFromAnywhere) {
  TemporaryFolder folder;
  Scene scene = earthScene();
  scene.albedoMap = "maps/../earth.jpg";
  ASSERT_EQ(writeScene(folder / "s.json", scene).error, "");
  EXPECT_EQ(test::contentsOf(folder / "s.json"), formatScene(scene));
  const Result<Scene> again = readScene(folder / "s.json");
  ASSERT_TRUE(again) << again.error;
  EXPECT_EQ(again->albedoMap, (std::filesystem::current_path() / "earth.jpg").string());
  EXPECT_EQ(sceneDifference(*again, withNormalPaths(scene)), "");
}

TEST(SceneFormat, WritesNoFileThatCantBeRead) {
  const std::pair<const char*, std::function<void(Scene*)>> bad[] = {
      {"latitude_deg", [](Scene* s) { s->camera.latitude = 2.0; }},
      {"altitude_m", [](Scene* s) { s->camera.altitude_m = std::nan(""); }},
      {"exposure", [](Scene* s) { s->exposure = -1.0; }},
      {"tone_map", [](Scene* s) { s->toneMap = static_cast<ToneMap>(9); }},
      {"solver", [](Scene* s) { s->solver = Solver::ONeil; }},
      {"quality", [](Scene* s) { s->quality = static_cast<Quality>(9); }},
      {"UTF-8", [](Scene* s) { s->albedoMap = "/maps/\xff.jpg"; }},
      {"height_map", [](Scene* s) { s->terrain.emplace().metersPerPixel[0] = 1.0; }}};
  TemporaryFolder folder;
  for (const auto& [word, spoil] : bad) {
    Scene scene = earthScene();
    spoil(&scene);
    const Done done = writeScene(folder / "s.json", scene);
    expectSentence(done.error);
    EXPECT_NE(done.error.find(word), std::string::npos) << done.error;
  }
  EXPECT_TRUE(folder.names().empty());
}

// The comparison itself: one change at a time, each is seen.
TEST(SceneFormat, TheComparisonCompares) {
  Scene base = earthScene();
  base.terrain.emplace();
  base.balloons.resize(1);
  base.stars.emplace();
  base.requirements.emplace().altitude_m[0] = 1.0;
  const std::function<void(Scene*)> changes[] = {
      [](Scene* s) { s->atmosphere.mie.asymmetry = 0.1; },
      [](Scene* s) { s->atmosphere.absorption.extinction_per_m[2] = 1.0; },
      [](Scene* s) { s->sun.azimuth = -0.0; },
      [](Scene* s) { s->camera.orthographicHeight_m = 1.0; },
      [](Scene* s) { s->albedoMap = "a"; },
      [](Scene* s) { s->terrain.reset(); },
      [](Scene* s) { s->terrain->metersPerPixel[1] = 2.0; },
      [](Scene* s) { s->terrain->albedoMap = "a"; },
      [](Scene* s) { s->balloons.clear(); },
      [](Scene* s) { s->balloons[0].color[1] = 0.1; },
      [](Scene* s) { s->stars->siderealHours = 1.0; },
      [](Scene* s) { s->exposure = 1.0; },
      [](Scene* s) { s->orders = 1; },
      [](Scene* s) { s->effects[kEffectCount - 1] = Force::On; },
      [](Scene* s) { s->requirements->altitude_m[0] = 2.0; },
      [](Scene* s) { s->requirements->sunElevation[1] = 0.0; },
      [](Scene* s) { s->requirements->budgetBytes = 1; },
      [](Scene* s) { s->requirements.reset(); }};
  std::set<std::string> seen;
  for (const auto& change : changes) {
    Scene changed = base;
    change(&changed);
    seen.insert(sceneDifference(base, changed));
  }
  EXPECT_EQ(seen.size(), std::size(changes));
  EXPECT_EQ(seen.count(""), 0u);
  EXPECT_EQ(sceneDifference(base, base), "");
  Scene next = base;
  next.sun.elevation = std::nextafter(base.sun.elevation, 1.0);
  EXPECT_NE(sceneDifference(base, next), "");
  EXPECT_EQ(sceneDifference(base, next, 1), "");
}

}  // namespace
}  // namespace alpenglow::io
