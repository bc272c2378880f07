// The field "terrain" of scene files.
#include <alpenglow/io/scene_file.h>

#include "temporary_folder.h"

namespace alpenglow::io {
namespace {

using test::expectSentence;

constexpr double kRadians = 3.14159265358979323846 / 180.0;

Result<Scene> parsed(const std::string& terrain) {
  return parseScene(R"({"atmosphere": "earth", "sun": {"elevation_deg": 5},
                        "camera": {"latitude_deg": 36.5, "longitude_deg": -84},
                        "terrain": )" +
                        terrain + "}",
                    "s.json", "folder");
}

std::string with(const std::string& field, const std::string& value) {
  return R"({"height_map": "a.png", "meters_per_pixel": 90, ")" + field + "\": " + value + "}";
}

void expectRefused(const std::string& terrain, std::initializer_list<const char*> words) {
  const Result<Scene> scene = parsed(terrain);
  EXPECT_FALSE(scene) << terrain;
  expectSentence(scene.error);
  for (const char* word : words)
    EXPECT_NE(scene.error.find(word), std::string::npos) << scene.error;
}

TEST(SceneTerrain, ReadsEveryField) {
  const Result<Scene> scene = parsed(
      R"({"height_map": "data/a.png", "meters_per_pixel": [74.5, 92.5], "meters_per_unit": 0.1,
          "height_scale": 3, "base_m": 236, "fade_m": 3000, "latitude_deg": 36.6,
          "longitude_deg": -84.25, "heading_deg": 10, "albedo": [0.1, 0.2, 1]})");
  ASSERT_TRUE(scene) << scene.error;
  const SceneTerrain& terrain = *scene->terrain;
  EXPECT_EQ(terrain.heightMap, "folder/data/a.png");
  EXPECT_EQ(terrain.metersPerPixel[0], 74.5);
  EXPECT_EQ(terrain.metersPerPixel[1], 92.5);
  EXPECT_EQ(terrain.metersPerUnit, 0.1);
  EXPECT_EQ(terrain.heightScale, 3.0);
  EXPECT_EQ(terrain.base_m, 236.0);
  EXPECT_EQ(terrain.fade_m, 3000.0);
  EXPECT_DOUBLE_EQ(terrain.latitude, 36.6 * kRadians);
  EXPECT_DOUBLE_EQ(terrain.longitude, -84.25 * kRadians);
  EXPECT_DOUBLE_EQ(terrain.heading, 10 * kRadians);
  EXPECT_EQ(terrain.albedo[0], 0.1);
  EXPECT_EQ(terrain.albedo[2], 1.0);
  EXPECT_TRUE(terrain.albedoMap.empty());
}

TEST(SceneTerrain, TheRestHasDefaults) {
  const Result<Scene> scene = parsed(R"({"height_map": "/a.png", "meters_per_pixel": 90})");
  ASSERT_TRUE(scene) << scene.error;
  const SceneTerrain& terrain = *scene->terrain;
  EXPECT_EQ(terrain.heightMap, "/a.png");
  EXPECT_EQ(terrain.metersPerPixel[0], 90.0);
  EXPECT_EQ(terrain.metersPerPixel[1], 90.0);
  EXPECT_EQ(terrain.metersPerUnit, 1.0);
  EXPECT_EQ(terrain.heightScale, 1.0);
  EXPECT_EQ(terrain.base_m, 0.0);
  EXPECT_EQ(terrain.fade_m, 0.0);
  EXPECT_DOUBLE_EQ(terrain.latitude, 36.5 * kRadians) << "The camera's.";
  EXPECT_DOUBLE_EQ(terrain.longitude, -84 * kRadians);
  EXPECT_EQ(terrain.heading, 0.0);
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    EXPECT_EQ(terrain.albedo[i], scene->atmosphere.groundAlbedo[i]);
  }
  EXPECT_FALSE(parsed("null")->terrain.has_value());
}

TEST(SceneTerrain, MayHaveAnAlbedoMapInstead) {
  const Result<Scene> scene = parsed(with("albedo_map", "\"b.jpg\""));
  ASSERT_TRUE(scene) << scene.error;
  EXPECT_EQ(scene->terrain->albedoMap, "folder/b.jpg");
  expectRefused(with("albedo_map", R"("b.jpg", "albedo": [0, 0, 0])"),
                {"'terrain.albedo'", "albedo_map"});
}

TEST(SceneTerrain, NamesMissingAndUnknownFields) {
  expectRefused("3", {"'terrain'", "3", "object"});
  expectRefused("{}", {"'terrain.height_map'", "missing"});
  expectRefused(R"({"height_map": "a.png"})", {"'terrain.meters_per_pixel'", "missing"});
  expectRefused(R"({"meters_per_pixel": 3})", {"'terrain.height_map'", "missing"});
  expectRefused(with("width_m", "3"), {"'terrain.width_m'", "unknown"});
}

TEST(SceneTerrain, RefusesWrongValuesByName) {
  const std::pair<const char*, const char*> bad[] = {{"meters_per_unit", "0"},
                                                     {"meters_per_unit", "-1"},
                                                     {"meters_per_unit", "null"},
                                                     {"height_scale", "0"},
                                                     {"height_scale", "\"2\""},
                                                     {"height_scale", "NaN"},
                                                     {"base_m", "1e10"},
                                                     {"base_m", "true"},
                                                     {"fade_m", "-1"},
                                                     {"fade_m", "1e999"},
                                                     {"latitude_deg", "90.5"},
                                                     {"latitude_deg", "null"},
                                                     {"longitude_deg", "Infinity"},
                                                     {"heading_deg", "\"north\""},
                                                     {"albedo", "[0.5, 0.5]"},
                                                     {"albedo", "[0, 0, 1.5]"},
                                                     {"albedo", "[0, -0.1, 0]"},
                                                     {"albedo", "0.5"},
                                                     {"albedo", "null"},
                                                     {"albedo_map", "3"},
                                                     {"albedo_map", "\"\""},
                                                     {"albedo_map", "null"}};
  for (const auto& [field, value] : bad) {
    expectRefused(with(field, value), {("'terrain." + std::string(field) + "'").c_str()});
  }
  for (const char* value : {"0", "-3", "null", "[3]", "[3, 0]", "[3, 3, 3]", "[\"3\", 3]", "\"3\"",
                            "NaN", "1e10", "{}"}) {
    expectRefused(std::string(R"({"height_map": "a.png", "meters_per_pixel": )") + value + "}",
                  {"'terrain.meters_per_pixel'"});
  }
  for (const char* value : {"3", "null", "\"\"", "[]"}) {
    expectRefused(std::string(R"({"meters_per_pixel": 3, "height_map": )") + value + "}",
                  {"'terrain.height_map'"});
  }
}

}  // namespace
}  // namespace alpenglow::io
