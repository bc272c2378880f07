#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/scene_file.h>

#include <cstring>

#include "temporary_folder.h"

namespace alpenglow::io {
namespace {

using test::expectSentence;
using test::TemporaryFolder;

constexpr double kRadians = 3.14159265358979323846 / 180.0;

const char* const kFull = R"({ "atmosphere": "earth",
  "sun": { "elevation_deg": 5, "azimuth_deg": 90, "disc_radius_deg": 0.25 },
  "camera": { "latitude_deg": 10, "longitude_deg": 20, "altitude_m": 300, "heading_deg": 91, "pitch_deg": 12, "roll_deg": 3,
              "projection": "perspective", "fov_deg": 50 },
  "ground": { "albedo_map": "data/earth.jpg" },
  "terrain": null, "size": [640, 480], "exposure": 2.5, "tone_map": "linear",
  "model": "bruneton", "solver": "standard", "orders": 3, "quality": "high", "shafts": "auto",
  "effects": { "light_shafts": "auto" } }
)";
const char* const kLeast =
    R"({ "atmosphere": "earth", "sun": { "elevation_deg": 5 }, "camera": {} })";

std::string with(const std::string& field, const std::string& value) {
  return "{ \"atmosphere\": \"earth\", \"sun\": { \"elevation_deg\": 5 }, \"camera\": {}, \"" +
         field + "\": " + value + " }";
}

std::string errorOf(const std::string& text) {
  const Result<Scene> result = parseScene(text, "s.json", "folder");
  EXPECT_FALSE(result) << text;
  expectSentence(result.error);
  return result.error;
}

void expectMentions(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
}

TEST(SceneFile, ReadsEveryField) {
  const Result<Scene> scene = parseScene(kFull, "s.json", "folder");
  ASSERT_TRUE(scene) << scene.error;
  EXPECT_DOUBLE_EQ(scene->sun.elevation, 5 * kRadians);
  EXPECT_DOUBLE_EQ(scene->sun.azimuth, 90 * kRadians);
  EXPECT_DOUBLE_EQ(scene->sun.discRadius, 0.25 * kRadians);
  EXPECT_DOUBLE_EQ(scene->camera.latitude, 10 * kRadians);
  EXPECT_DOUBLE_EQ(scene->camera.longitude, 20 * kRadians);
  EXPECT_EQ(scene->camera.altitude_m, 300.0);
  EXPECT_DOUBLE_EQ(scene->camera.heading, 91 * kRadians);
  EXPECT_DOUBLE_EQ(scene->camera.pitch, 12 * kRadians);
  EXPECT_DOUBLE_EQ(scene->camera.roll, 3 * kRadians);
  EXPECT_EQ(scene->camera.projection, Projection::Perspective);
  EXPECT_DOUBLE_EQ(scene->camera.fov, 50 * kRadians);
  EXPECT_EQ(scene->albedoMap, "folder/data/earth.jpg");
  EXPECT_EQ(scene->width, 640u);
  EXPECT_EQ(scene->height, 480u);
  EXPECT_EQ(scene->exposure, 2.5);
  EXPECT_EQ(scene->toneMap, ToneMap::Linear);
  EXPECT_EQ(scene->solver, Solver::Standard);
  EXPECT_EQ(scene->orders, 3u);
  EXPECT_EQ(scene->quality, Quality::High);
}

TEST(SceneFile, TheRestHasDefaults) {
  const Result<Scene> scene = parseScene(kLeast, "s.json", "");
  ASSERT_TRUE(scene) << scene.error;
  EXPECT_EQ(scene->width, 1024u);
  EXPECT_EQ(scene->height, 768u);
  EXPECT_FALSE(scene->exposure.has_value());
  EXPECT_EQ(scene->toneMap, ToneMap::Filmic);
  EXPECT_FALSE(scene->orders.has_value());
  EXPECT_FALSE(scene->solver.has_value());
  EXPECT_FALSE(scene->quality.has_value());
  EXPECT_TRUE(scene->albedoMap.empty());
  EXPECT_EQ(scene->camera.altitude_m, 2.0);
  EXPECT_DOUBLE_EQ(scene->camera.fov, 60 * kRadians);
  EXPECT_DOUBLE_EQ(scene->sun.discRadius, 0.2667 * kRadians);
  const Result<Scene> fisheye = parseScene(
      R"({"atmosphere": "mars", "sun": {"elevation_deg": -3}, "camera": {"projection": "fisheye"}})",
      "s.json", "");
  ASSERT_TRUE(fisheye) << fisheye.error;
  EXPECT_DOUBLE_EQ(fisheye->camera.fov, 180 * kRadians);
}

TEST(SceneFile, NamesMissingAndUnknownFields) {
  for (const char* field : {"atmosphere", "sun", "camera"}) {
    std::string text = kLeast;
    text.replace(text.find(field), std::string(field).size(), "spot");
    EXPECT_NE(errorOf(text).find("'spot'"), std::string::npos);
  }
  expectMentions(errorOf("{}"), {"s.json", "'atmosphere'", "missing"});
  expectMentions(errorOf(R"({"atmosphere": "earth", "camera": {}})"), {"'sun'", "missing"});
  expectMentions(errorOf(R"({"atmosphere": "earth", "camera": {}, "sun": {}})"),
                 {"'sun.elevation_deg'", "missing"});
  expectMentions(errorOf(with("colour", "1")), {"'colour'", "unknown"});
  expectMentions(errorOf(with("ground", "{\"map\": 1}")), {"'ground.map'", "unknown"});
  expectMentions(errorOf(with("effects", "{\"rain\": \"on\"}")), {"'effects.rain'", "unknown"});
}

TEST(SceneFile, RefusesWrongValuesByName) {
  const std::pair<const char*, const char*> bad[] = {
      {"size", "[0, 10]"},       {"size", "[10]"},          {"size", "[10.5, 3]"},
      {"size", "[99999, 3]"},    {"size", "\"big\""},       {"size", "[-1, 3]"},
      {"exposure", "0"},         {"exposure", "-1"},        {"exposure", "\"bright\""},
      {"exposure", "1e999"},     {"tone_map", "\"x\""},     {"tone_map", "null"},
      {"orders", "0"},           {"orders", "1001"},        {"orders", "2.5"},
      {"orders", "\"many\""},    {"ground", "3"},           {"ground", "{\"albedo_map\": 3}"},
      {"shaft_samples", "0"},    {"shaft_samples", "4097"}, {"shaft_samples", "1.5"},
      {"shaft_samples", "null"}, {"shafts", "\"volumes\""}, {"shafts", "null"}};
  for (const auto& [field, value] : bad) expectMentions(errorOf(with(field, value)), {field});
  const std::pair<const char*, const char*> camera[] = {
      {"latitude_deg", "91"}, {"pitch_deg", "-91"}, {"fov_deg", "0"},        {"fov_deg", "180"},
      {"altitude_m", "NaN"},  {"roll_deg", "\"\""}, {"projection", "\"x\""}, {"height_m", "100"}};
  for (const auto& [field, value] : camera) {
    const std::string text = std::string(R"({"atmosphere":"earth","sun":{"elevation_deg":1},)") +
                             "\"camera\":{\"" + field + "\":" + value + "}}";
    expectMentions(errorOf(text), {field, "camera."});
  }
  expectMentions(errorOf(R"({"atmosphere":"earth","camera":{},"sun":{"elevation_deg":90.5}})"),
                 {"sun.elevation_deg", "90.5", "-90 to 90"});
}

// A parser that ends at the NUL would take "earth\\u0000x" for "earth".
TEST(SceneFile, RefusesNulCharacters) {
  const std::string good = R"({"atmosphere":"earth","camera":{},"sun":{"elevation_deg":1}})";
  ASSERT_TRUE(parseScene(good, "s.json", "folder"));
  const std::string nul(1, '\0');
  for (const std::string& text : {good + nul + "garbage", nul + good, good + nul})
    expectMentions(errorOf(text), {"NUL", "byte"});
  for (const char* part : {"earth", "atmosphere", "elevation_deg"}) {
    std::string text = good;
    text.insert(text.find(part) + std::strlen(part), "\\u0000x");
    expectMentions(errorOf(text), {"NUL", "\\u0000"});
  }
}

TEST(SceneFile, FeaturesOfLaterVersionsAreRefusedWithWhatExists) {
  expectMentions(errorOf(with("model", "\"preetham\"")), {"'model'", "\"bruneton\""});
  expectMentions(errorOf(with("shafts", "\"volumes\"")), {"'shafts'", "\"off\""});
  expectMentions(errorOf(with("effects", "{\"light_shafts\": \"perhaps\"}")),
                 {"'effects.light_shafts'", "\"on\""});
}

TEST(SceneFile, ModelsHaveTheirNames) {
  const auto read = [](const std::string& fields) {
    return parseScene(with("size", "[3, 2], " + fields), "s.json", "");
  };
  const std::pair<const char*, Solver> models[] = {{"hoffman-preetham", Solver::HoffmanPreetham},
                                                   {"oneil", Solver::ONeil},
                                                   {"schafhitzel", Solver::Schafhitzel},
                                                   {"hillaire", Solver::Hillaire}};
  for (const auto& [name, solver] : models) {
    const std::string model = std::string("\"model\": \"") + name + "\"";
    const Result<Scene> scene = read(model);
    ASSERT_TRUE(scene) << scene.error;
    EXPECT_EQ(modelName(scene->model), name);
    EXPECT_EQ(solverOf(scene->model), solver);
    for (const char* choice : {"\"solver\": \"standard\"", "\"orders\": 3", "\"quality\": \"low\""})
      expectMentions(read(model + ", " + choice).error, {"left out", name});
    const bool samples = solver == Solver::ONeil || solver == Solver::Hillaire;
    const Result<Scene> sampled = read(model + ", \"model_samples\": 7");
    ASSERT_EQ(static_cast<bool>(sampled), samples) << sampled.error;
    if (samples) {
      EXPECT_EQ(sampled->modelStepCount, 7u);
    } else {
      expectMentions(sampled.error, {"'model_samples'", name});
    }
  }
  const Result<Scene> single = read("\"model\": \"single\"");
  ASSERT_TRUE(single) << single.error;
  EXPECT_EQ(single->orders, 1u);
  EXPECT_FALSE(solverOf(single->model));
  expectMentions(read("\"model\": \"single\", \"orders\": 2").error, {"'orders'", "single"});
}

TEST(SceneFile, LightShaftsHaveTheirNames) {
  const auto shafts = [](const std::string& fields) {
    const Result<Scene> result = parseScene(with("size", "[3, 2], " + fields), "s.json", "");
    EXPECT_TRUE(result) << result.error;
    return result ? *result : Scene{};
  };
  EXPECT_EQ(shafts("\"model\": \"bruneton\"").shafts, SceneLightShafts::Auto);
  EXPECT_EQ(shafts("\"model\": \"bruneton\"").lightShaftStepCount, 32u);
  EXPECT_EQ(shafts("\"shafts\": \"auto\"").shafts, SceneLightShafts::Auto);
  EXPECT_EQ(shafts("\"shafts\": \"paper\"").shafts, SceneLightShafts::ShadowVolume);
  EXPECT_EQ(shafts("\"shafts\": \"exact\"").shafts, SceneLightShafts::LightVolume);
  EXPECT_EQ(shafts("\"shafts\": \"march\", \"shaft_samples\": 4096").shafts,
            SceneLightShafts::RayMarch);
  EXPECT_EQ(shafts("\"shafts\": \"march\", \"shaft_samples\": 4096").lightShaftStepCount, 4096u);
  EXPECT_EQ(shafts("\"shafts\": \"off\"").shafts, SceneLightShafts::Off);
  EXPECT_EQ(shafts("\"shafts\": \"exact\", \"effects\": {\"light_shafts\": \"off\"}").shafts,
            SceneLightShafts::Off);
  EXPECT_EQ(shafts("\"shafts\": \"exact\", \"effects\": {\"light_shafts\": \"auto\"}").shafts,
            SceneLightShafts::LightVolume);
}

TEST(SceneFile, StarsAreThereOrNot) {
  const auto stars = [](const char* value) {
    const Result<Scene> result = parseScene(with("stars", value), "s.json", "");
    EXPECT_TRUE(result) << result.error;
    return result ? result->stars : std::nullopt;
  };
  EXPECT_FALSE(parseScene(kLeast, "s.json", "")->stars.has_value());
  EXPECT_FALSE(stars("null").has_value());
  EXPECT_FALSE(stars("false").has_value());
  EXPECT_EQ(stars("true")->siderealHours, 0.0);
  EXPECT_EQ(stars("{}")->siderealHours, 0.0);
  EXPECT_EQ(stars("{\"sidereal_hours\": -30.5}")->siderealHours, -30.5);
  expectMentions(errorOf(with("stars", "3")), {"'stars'", "3", "sidereal_hours"});
  expectMentions(errorOf(with("stars", "{\"hours\": 3}")), {"'stars.hours'", "unknown"});
  expectMentions(errorOf(with("stars", "{\"sidereal_hours\": \"six\"}")),
                 {"'stars.sidereal_hours'", "six"});
}

std::string withCamera(const std::string& camera) {
  return R"({"atmosphere": "earth", "sun": {"elevation_deg": 1}, "camera": )" + camera + "}";
}

TEST(SceneFile, AnOrthographicCameraHasAHeightAndNoAngle) {
  const Result<Scene> scene =
      parseScene(withCamera(R"({"projection": "orthographic", "height_m": 30000})"), "s.json", "");
  ASSERT_TRUE(scene) << scene.error;
  EXPECT_EQ(scene->camera.orthographicHeight_m, 30000.0);
  EXPECT_EQ(scene->camera.projection, Projection::Perspective);
  EXPECT_EQ(scene->camera.fov, 0.0);
  EXPECT_FALSE(parseScene(kLeast, "s.json", "")->camera.orthographicHeight_m.has_value());
  expectMentions(errorOf(withCamera(R"({"projection": "orthographic"})")),
                 {"'camera.height_m'", "missing"});
  for (const char* height : {"0", "-1", "2e12", "null", "\"tall\"", "NaN"}) {
    expectMentions(
        errorOf(withCamera(std::string(R"({"projection": "orthographic", "height_m": )") + height +
                           "}")),
        {"'camera.height_m'"});
  }
  expectMentions(
      errorOf(withCamera(R"({"projection": "orthographic", "height_m": 1, "fov_deg": 60})")),
      {"'camera.fov_deg'", "60", "left out"});
  expectMentions(errorOf(withCamera(R"({"projection": "fisheye", "height_m": 5})")),
                 {"'camera.height_m'", "5", "left out"});
}

TEST(SceneFile, SolverAndQualityHaveTheirNames) {
  const auto scene = [](const char* field, const char* value) {
    const Result<Scene> result = parseScene(with(field, value), "s.json", "");
    EXPECT_TRUE(result) << result.error;
    return result ? *result : Scene{};
  };
  EXPECT_EQ(scene("solver", "\"moments\"").solver, Solver::Moments);
  EXPECT_EQ(scene("solver", "\"standard\"").solver, Solver::Standard);
  EXPECT_FALSE(scene("solver", "null").solver.has_value());
  EXPECT_EQ(scene("quality", "\"draft\"").quality, Quality::Draft);
  EXPECT_EQ(scene("quality", "\"ultra\"").quality, Quality::Ultra);
  EXPECT_FALSE(scene("quality", "null").quality.has_value());
  expectMentions(errorOf(with("solver", "\"exact\"")),
                 {"'solver'", "\"exact\"", "\"moments\" or \"standard\""});
  expectMentions(errorOf(with("quality", "\"best\"")), {"'quality'", "\"best\"", "\"draft\""});
  expectMentions(errorOf(with("quality", "3")), {"'quality'", "3"});
}

TEST(SceneFile, TheAtmosphereIsAPresetAFileOrInline) {
  TemporaryFolder folder;
  Parameters mars;
  ASSERT_EQ(findPreset("mars", &mars, {}), Status::Ok);
  const std::string atmosphere = formatAtmosphere(mars);
  std::filesystem::create_directory(folder / "sub");
  folder.write("sub/air.json", atmosphere);
  const auto scene = [](const std::string& value) {
    return "{\"atmosphere\": " + value + ", \"sun\": {\"elevation_deg\": 1}, \"camera\": {}}";
  };
  for (const std::string& value : {std::string("\"mars\""), std::string("\"sub/air.json\""),
                                   std::string("\"./sub/air.json\""), atmosphere}) {
    const Result<Scene> result = readScene(folder.write("scene.json", scene(value)));
    ASSERT_TRUE(result) << result.error;
    EXPECT_EQ(firstDifference(result->atmosphere, mars), "");
  }
  expectMentions(readScene(folder.write("bad.json", scene("\"pluto\""))).error, {"\"pluto\""});
  expectMentions(readScene(folder.write("bad.json", scene("3"))).error, {"'atmosphere'", "3"});
  expectMentions(readScene(folder.write("bad.json", scene("{}"))).error,
                 {"'atmosphere.bottom_radius_m'", "missing"});
  folder.write("sub/bad.json", "{]");
  expectMentions(readScene(folder.write("bad.json", scene("\"sub/bad.json\""))).error,
                 {"sub/bad.json", "JSON"});
}

TEST(SceneFile, ScenesAndAtmospheresAreDistinguishedByContent) {
  TemporaryFolder folder;
  Parameters mars;
  ASSERT_EQ(findPreset("mars", &mars, {}), Status::Ok);
  const std::string air = folder.write("a", formatAtmosphere(mars));
  const std::string scene = folder.write("b", kLeast);
  ASSERT_TRUE(findAtmosphereOrScene(air)) << findAtmosphereOrScene(air).error;
  EXPECT_FALSE(findAtmosphereOrScene(air)->scene.has_value());
  ASSERT_TRUE(findAtmosphereOrScene(scene));
  EXPECT_TRUE(findAtmosphereOrScene(scene)->scene.has_value());
  ASSERT_TRUE(findAtmosphereOrScene("mars"));
  EXPECT_EQ(firstDifference(findAtmosphereOrScene("mars")->parameters, mars), "");
  expectMentions(findAtmosphereOrScene("pluto").error, {"'pluto'", "preset"});
  expectSentence(findAtmosphereOrScene("pluto").error);
  expectSentence(findAtmosphereOrScene(folder.write("c", "{}")).error);
}

}  // namespace
}  // namespace alpenglow::io
