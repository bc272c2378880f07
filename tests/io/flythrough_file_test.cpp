#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/flythrough_file.h>

#include <cmath>
#include <filesystem>

#include "schema.h"
#include "temporary_folder.h"

namespace alpenglow::io {
namespace {

using test::expectSentence;

constexpr double kRadians = 3.14159265358979323846 / 180.0;

std::string flythroughOf(const std::string& keys, const std::string& more = "") {
  return R"({ "scene": { "atmosphere": "earth", "sun": { "elevation_deg": 10, "azimuth_deg": 350 },
      "camera": { "altitude_m": 9, "heading_deg": 10, "fov_deg": 40 }, "exposure": 2 })" +
         more + R"(, "keys": [)" + keys + "] }";
}

Flythrough parsed(const std::string& text) {
  const Result<Flythrough> flythrough = parseFlythrough(text, "w.json", "folder");
  EXPECT_TRUE(flythrough) << flythrough.error;
  return flythrough ? *flythrough : Flythrough{};
}

void expectRefused(const std::string& text, std::initializer_list<const char*> words) {
  const Result<Flythrough> flythrough = parseFlythrough(text, "w.json", "folder");
  ASSERT_FALSE(flythrough) << text;
  expectSentence(flythrough.error);
  EXPECT_NE(flythrough.error.find("'w.json'"), std::string::npos) << flythrough.error;
  for (const char* word : words)
    EXPECT_NE(flythrough.error.find(word), std::string::npos) << flythrough.error;
}

/// What a key at 2 s gives, after one at 0 s that gives nothing.
std::string to(const std::string& fields) {
  return flythroughOf(R"({ "time_s": 0 }, { "time_s": 2, )" + fields + "}");
}

TEST(FlythroughFile, KeysInheritMissingValues) {
  const Flythrough flythrough = parsed(flythroughOf(R"(
      { "time_s": 0, "caption": "a" },
      { "time_s": 1, "sun": { "elevation_deg": -5 } },
      { "time_s": 2, "caption": "c", "move": "cut", "camera": { "pitch_deg": 7, "fov_deg": null },
        "atmosphere": { "mie": { "asymmetry": 0.5 }, "absorption": null } },
      { "time_s": 3, "move": "linear" })",
                                                    R"(, "title": "t", "frames_per_second": 10)"));
  ASSERT_EQ(flythrough.keys.size(), 4u);
  EXPECT_EQ(flythrough.title, "t");
  EXPECT_EQ(flythrough.framesPerSecond, 10.0);
  EXPECT_EQ(flythrough.keys[0].caption, "a");
  EXPECT_EQ(flythrough.keys[1].caption, "");
  EXPECT_EQ(flythrough.keys[1].move, FlythroughMove::Smooth);
  EXPECT_EQ(flythrough.keys[2].move, FlythroughMove::Cut);
  EXPECT_EQ(flythrough.keys[3].move, FlythroughMove::Linear);
  const Scene& last = flythrough.keys[3].scene;
  EXPECT_DOUBLE_EQ(last.sun.elevation, -5 * kRadians);
  EXPECT_DOUBLE_EQ(last.sun.azimuth, 350 * kRadians);
  EXPECT_DOUBLE_EQ(last.camera.pitch, 7 * kRadians);
  EXPECT_DOUBLE_EQ(last.camera.fov, 60 * kRadians) << "the default";
  EXPECT_DOUBLE_EQ(last.camera.heading, 10 * kRadians);
  Parameters earth;
  findPreset("earth", &earth, {});
  EXPECT_EQ(firstDifference(flythrough.keys[1].scene.atmosphere, earth), "");
  EXPECT_EQ(last.atmosphere.mie.asymmetry, 0.5);
  EXPECT_FALSE(last.atmosphere.absorption.present);
  EXPECT_EQ(last.atmosphere.mie.scaleHeight_m, earth.mie.scaleHeight_m);
}

TEST(FlythroughFile, Refusals) {
  expectRefused("[]", {"object"});
  expectRefused("{", {"JSON"});
  expectRefused(R"({ "scene": {}, "keys": [] })", {"the scene: ", "'atmosphere'"});
  expectRefused(flythroughOf(""), {"'keys'", "1 to"});
  expectRefused(flythroughOf("3"), {"key 0: "});
  expectRefused(flythroughOf("{}"), {"key 0: ", "'time_s'", "missing"});
  expectRefused(flythroughOf(R"({ "time_s": 1 })"), {"key 0: ", "'time_s' is 1", "must be 0"});
  expectRefused(flythroughOf(R"({ "time_s": 0 }, { "time_s": 0 })"), {"key 1: ", "'time_s' is 0"});
  expectRefused(to(R"("wind": 1)"), {"key 1: ", "'wind'"});
  expectRefused(to(R"("move": "jump")"), {"'move'", "jump", "cut"});
  expectRefused(to(R"("terrain": null)"), {"'terrain'"});
  expectRefused(to(R"("sun": { "elevation_deg": 91 })"), {"key 1: ", "'sun.elevation_deg' is 91"});
  expectRefused(to(R"("sun": { "colour": 1 })"), {"'sun.colour'"});
  expectRefused(to(R"("atmosphere": { "mie": { "asymmetry": 1 } })"), {"key 1: ", "mie.asymmetry"});
  expectRefused(to(R"("atmosphere": { "fog": 1 })"), {"'atmosphere.fog'"});
  expectRefused(to(R"("atmosphere": "venus")"), {"venus", "preset"});
  expectRefused(flythroughOf(R"({ "time_s": 0 })", R"(, "frames_per_second": 0)"),
                {"frames_per_second"});
  expectRefused(flythroughOf(R"({ "time_s": 0 }, { "time_s": 99999 })"),
                {"2399977 frames", "1000000"});
}

TEST(FlythroughFile, DiscreteValuesMustChangeAtCuts) {
  const std::pair<const char*, const char*> kChanges[] = {
      {R"("exposure": "auto")", "'exposure' changes from a number to \"auto\""},
      {R"("stars": true)", "'stars' comes"},
      {R"("camera": { "projection": "fisheye" })", "'camera.projection'"},
      {R"("camera": { "projection": "orthographic", "height_m": 5, "fov_deg": null })",
       "'camera.projection'"},
      {R"("atmosphere": { "mie": null })", "'atmosphere.mie' goes"},
      {R"("camera": { "longitude_deg": 180 })", "other side"}};
  for (const auto& [change, words] : kChanges) {
    expectRefused(to(change), {"key 1: ", words, "\"cut\""});
    EXPECT_EQ(parsed(to(std::string(change) + R"(, "move": "cut")")).keys.size(), 2u) << change;
  }
}

TEST(FlythroughFile, TerrainFixesThePlanetsRadius) {
  const std::string start =
      R"({ "scene": { "atmosphere": "earth", "sun": { "elevation_deg": 10 }, "camera": {},
           "balloons": [{ "latitude_deg": 0, "longitude_deg": 0, "altitude_m": 9 }] }, "keys": [
           { "time_s": 0 }, { "time_s": 2, "move": "cut", "atmosphere": )";
  expectRefused(start + R"({ "bottom_radius_m": 6350000 } }] })",
                {"key 1: ", "bottom_radius_m", "6350000"});
  parsed(start + R"({ "top_radius_m": 6430000 } }] })");
}

TEST(FlythroughFile, SchemaAgreesWithTheReaderOnFlythroughs) {
  size_t flythroughs = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ALPENGLOW_FLYTHROUGH_FOLDER)) {
    const Result<Flythrough> flythrough = readFlythrough(entry.path().string());
    EXPECT_TRUE(flythrough) << flythrough.error;
    const nlohmann::json json =
        nlohmann::json::parse(test::contentsOf(entry.path().string()), nullptr, false);
    EXPECT_EQ(test::schemaError(ALPENGLOW_SCHEMA_FOLDER, "walk.schema.json", json), "");
    ++flythroughs;
  }
  EXPECT_GE(flythroughs, 4u);
  const nlohmann::json values[] = {
      nullptr, 0, -1, 91, "x", "auto", "cut", true, {1}, "mars", nlohmann::json::object()};
  for (const char* field :
       {"time_s", "caption", "move", "sun", "camera", "exposure", "stars", "atmosphere", "other"}) {
    for (const nlohmann::json& value : values) {
      nlohmann::json json =
          nlohmann::json::parse(flythroughOf(R"({ "time_s": 0 }, { "time_s": 2, "move": "cut" })"));
      json["keys"][1][field] = value;
      const bool read = static_cast<bool>(parseFlythrough(json.dump(), "w.json", ""));
      const std::string error =
          test::schemaError(ALPENGLOW_SCHEMA_FOLDER, "walk.schema.json", json);
      // A schema can't know presets, nor compare times.
      const bool unknowable = value == "x" || value == "auto" || value == "cut" || value == 0;
      if (unknowable && error.empty()) continue;
      EXPECT_EQ(read, error.empty()) << json.dump() << " " << error;
    }
  }
}

}  // namespace
}  // namespace alpenglow::io
