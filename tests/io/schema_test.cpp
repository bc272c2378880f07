// The schemas of docs/schema say what the readers and writers do.
#include "schema.h"

#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/probe_file.h>
#include <alpenglow/io/report_file.h>
#include <alpenglow/io/scene_file.h>

#include "temporary_folder.h"

#include "tests/parameters/heard.h"

namespace alpenglow::io {
namespace {

using Json = nlohmann::json;

std::string errorOf(const char* schema, const Json& value) {
  return test::schemaError(ALPENGLOW_SCHEMA_FOLDER, schema, value);
}

TEST(Schema, EveryPresetIsAnAtmosphere) {
  for (const Preset& listed : testing::allPresets()) {
    Parameters preset;
    ASSERT_EQ(findPreset(listed.name, &preset, {}), Status::Ok);
    EXPECT_EQ(errorOf("atmosphere.schema.json", Json::parse(formatAtmosphere(preset))), "");
  }
}

TEST(Schema, EverySampleSceneIsAScene) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(ALPENGLOW_SCENE_FOLDER)) {
    if (entry.path().extension() != ".json") continue;
    ++count;
    EXPECT_EQ(errorOf("scene.schema.json", Json::parse(test::contentsOf(entry.path().string()))),
              "")
        << entry.path();
    const Result<Scene> scene = readScene(entry.path().string());
    EXPECT_TRUE(scene) << scene.error;
  }
  EXPECT_GT(count, 5);
}

// One change at a time to a good file: reader and schema agree on each.
TEST(Schema, ReaderAndSchemaRefuseTheSameScenes) {
  Json good = Json::parse(R"({ "atmosphere": "earth", "sun": { "elevation_deg": 5 },
    "camera": { "fov_deg": 50, "projection": "fisheye" }, "ground": { "albedo_map": null },
    "size": [640, 480], "exposure": 2.5, "tone_map": "linear", "model": "bruneton",
    "model_samples": null, "solver": null, "orders": null, "quality": null, "shafts": "march", "shaft_samples": 32,
    "terrain": { "height_map": "a.png", "meters_per_pixel": [3, 4.5], "meters_per_unit": 2,
                 "height_scale": 1, "base_m": 1, "fade_m": 0, "latitude_deg": 1, "longitude_deg": 2,
                 "heading_deg": 3, "albedo": [0, 0.5, 1] },
    "balloons": [{ "latitude_deg": 1, "longitude_deg": 2, "altitude_m": 3, "radius_m": 4,
                   "color": [0, 0.5, 1], "opacity": 0.5 }],
    "stars": { "sidereal_hours": 3 }, "effects": { "light_shafts": "auto" } })");
  Parameters mars;
  ASSERT_EQ(findPreset("mars", &mars, {}), Status::Ok);
  const Json air = Json::parse(formatAtmosphere(mars));
  const Json values[] = {nullptr,
                         0,
                         1,
                         -3,
                         2.5,
                         100,
                         400,
                         "auto",
                         "off",
                         "on",
                         "standard",
                         true,
                         "filmic",
                         "moments",
                         "high",
                         "linear",
                         "orthographic",
                         "paper",
                         "",
                         {0.5, 0.5, 0.5},
                         {640, 480},
                         {1, 2, 3},
                         {0, 5},
                         {2.5, 3},
                         air,
                         "earth",
                         Json::object(),
                         {{"elevation_deg", 3}},
                         {{"projection", "orthographic"}, {"height_m", 3}},
                         {{"height_map", "a.png"}, {"meters_per_pixel", 3}},
                         {{"other", 1}}};
  int refused = 0;
  const auto compare = [&](const Json& scene) {
    const bool read = static_cast<bool>(parseScene(scene.dump(), "s.json", ""));
    const std::string error = errorOf("scene.schema.json", scene);
    // A schema can't know which names are presets or files.
    const bool nameless = scene.contains("atmosphere") && scene["atmosphere"].is_string() &&
                          scene["atmosphere"] != "earth";
    if (!nameless) {
      EXPECT_EQ(read, error.empty()) << scene.dump() << " " << error;
    }
    refused += read ? 0 : 1;
  };
  compare(good);
  Json orthographic = good;
  orthographic["camera"] = {{"projection", "orthographic"}, {"height_m", 3000}};
  compare(orthographic);
  EXPECT_EQ(refused, 0);
  for (const char* key : {"fov_deg", "height_m", "projection", "roll_deg"}) {
    for (const Json& value : values) {
      Json changed = orthographic;
      changed["camera"][key] = value;
      compare(changed);
    }
    Json reduced = orthographic;
    reduced["camera"].erase(key);
    compare(reduced);
  }
  for (const std::string& model : modelNames()) {
    Json other = good;
    other["model"] = model;
    for (const char* key : {"model_samples", "solver", "orders", "quality"}) {
      for (const Json& value : values) {
        other[key] = value;
        compare(other);
      }
      other[key] = nullptr;
    }
  }
  for (const auto& field : good["terrain"].items()) {
    Json reduced = good;
    reduced["terrain"].erase(field.key());
    compare(reduced);
  }
  const Json balloon = good["balloons"][0];
  for (const auto& field : balloon.items()) {
    Json reduced = good;
    reduced["balloons"][0].erase(field.key());
    compare(reduced);
    for (const Json& value : values) {
      Json changed = good;
      changed["balloons"][0][field.key()] = value;
      compare(changed);
    }
  }
  for (const auto& field : good.items()) {
    Json reduced = good;
    reduced.erase(field.key());
    compare(reduced);
    for (const Json& value : values) {
      Json changed = good;
      changed[field.key()] = value;
      compare(changed);
    }
  }
  for (const char* object : {"sun", "camera", "ground", "terrain", "stars", "effects"}) {
    for (const char* key :
         {"elevation_deg", "azimuth_deg",      "disc_radius_deg", "latitude_deg", "altitude_m",
          "pitch_deg",     "projection",       "fov_deg",         "height_m",     "light_shafts",
          "height_map",    "meters_per_pixel", "meters_per_unit", "height_scale", "base_m",
          "fade_m",        "longitude_deg",    "heading_deg",     "albedo",       "albedo_map",
          "sidereal_hours"}) {
      for (const Json& value : values) {
        Json changed = good;
        changed[object][key] = value;
        compare(changed);
      }
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(Schema, ReaderAndSchemaRefuseTheSameQueries) {
  const Json good = Json::parse(
      R"([{"id": "a", "altitude_m": 2, "view_zenith_deg": 88, "sun_zenith_deg": 92,
           "azimuth_deg": 45, "distance_m": null},
          {"id": "b", "kind": "irradiance", "altitude_m": 0, "sun_zenith_deg": 60}])");
  const Json values[] = {nullptr, 0, -1, 90, 181, "x", "irradiance", true, Json::object(), {1}};
  for (const Json& query : good) {
    for (const char* key : {"id", "kind", "altitude_m", "view_zenith_deg", "sun_zenith_deg",
                            "azimuth_deg", "distance_m", "other"}) {
      for (const Json& value : values) {
        Json changed = query;
        changed[key] = value;
        const Json file = {{"queries", Json::array({changed})}};
        const bool read = static_cast<bool>(parseQueries(file.dump(), "q.json"));
        const std::string error = errorOf("probe.schema.json", file);
        EXPECT_EQ(read, error.empty()) << file.dump() << " " << error;
      }
    }
  }
}

TEST(Schema, WrittenAnswersAndReportsObey) {
  NamedQuery ray{"a", {}};
  NamedQuery surface{"b", {}};
  surface.query.kind = QueryKind::Irradiance;
  const auto plain = formatAnswers({ray, surface}, std::vector<ProbeAnswer>(2));
  const auto reference = formatAnswers({ray, surface}, std::vector<ReferenceAnswer>(2));
  EXPECT_EQ(errorOf("answers.schema.json", Json::parse(*plain)), "");
  EXPECT_EQ(errorOf("answers.schema.json", Json::parse(*reference)), "");
  Report report;
  EXPECT_EQ(errorOf("report.schema.json", Json::parse(formatReport(report))), "");
  report.device = "a \"device\"";
  report.totals.bytes = uint64_t{5} << 33;
  report.totals.shaderVariants = 3;
  report.passes = {{"T", 1, 0, 10, 0.25, std::nullopt}, {"sky", 0, 1, 20, 0.5, 0.125}};
  const Json json = Json::parse(formatReport(report));
  EXPECT_EQ(errorOf("report.schema.json", json), "");
  EXPECT_EQ(json["device"], report.device);
  EXPECT_EQ(json["totals"]["bytes"], uint64_t{5} << 33);
  EXPECT_EQ(json["totals"]["shader_variants"], 3);
  EXPECT_EQ(json["passes"][0]["cpu_seconds"], 0.25);
  EXPECT_TRUE(json["passes"][0]["gpu_seconds"].is_null());
  EXPECT_EQ(json["passes"][1]["gpu_seconds"], 0.125);
  EXPECT_EQ(json["passes"][1]["draws"], 1);
}

TEST(Schema, TheCheckerChecks) {
  EXPECT_NE(errorOf("report.schema.json", Json::object()), "");
  EXPECT_NE(
      errorOf("report.schema.json", Json::parse(R"({"device": 3, "totals": {}, "passes": []})")),
      "");
  Json answers = Json::parse(R"({"answers": [{"id": "b", "direct": [1, 2], "sky": [0, 0, 0]}]})");
  EXPECT_NE(errorOf("answers.schema.json", answers), "");
  answers["answers"][0]["direct"] = {1, 2, 3};
  EXPECT_EQ(errorOf("answers.schema.json", answers), "");
}

}  // namespace
}  // namespace alpenglow::io
