// Scenes as text: what scene_file.cpp reads, written.
#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/file.h>
#include <alpenglow/io/scene_file.h>
#include <alpenglow/io/table_file.h>

#include <algorithm>
#include <filesystem>
#include <span>

#include "atmosphere/io/atmosphere_json.h"
#include "atmosphere/io/scene_json.h"

namespace alpenglow::io {
namespace {

std::string absolutePath(const std::string& path) {
  if (path.empty()) return path;
  std::error_code code;
  const std::filesystem::path absolute = std::filesystem::absolute(path, code);
  return (code ? std::filesystem::path(path) : absolute).lexically_normal().string();
}

// JSON holds UTF-8 alone, and its writer throws at anything else.
std::string asUtf8(const std::string& text) {
  const std::string quoted = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return Json::parse(quoted).get<std::string>();
}

std::string pathText(const std::string& path) { return asUtf8(absolutePath(path)); }

// A value without a name becomes its number, which readers refuse with a sentence.
template <typename T>
std::string nameOf(const std::vector<std::string>& names, T value, T first = T{}) {
  const size_t index = static_cast<size_t>(value) - static_cast<size_t>(first);
  return index < names.size() ? names[index] : std::to_string(static_cast<size_t>(value));
}

OrderedJson spectrumJson(const Spectrum& spectrum) {
  OrderedJson array = OrderedJson::array();
  for (const double value : spectrum.value) array.push_back(value);
  return array;
}

// Where the object would be a preset's, all digits of it, its name reads back as the same bits.
OrderedJson atmosphereOf(const Parameters& parameters) {
  const std::string text = formatAtmosphere(parameters);
  uint32_t count = 0;
  const Preset* const all = presets(&count);
  for (const Preset& preset : std::span(all, count))
    if (formatAtmosphere(preset.parameters) == text) return preset.name;
  return atmosphereToJson(parameters);
}

OrderedJson sunJson(const SceneSun& sun) {
  return {{"elevation_deg", shortestDegrees(sun.elevation)},
          {"azimuth_deg", shortestDegrees(sun.azimuth)},
          {"disc_radius_deg", shortestDegrees(sun.discRadius)}};
}

OrderedJson cameraJson(const SceneCamera& camera) {
  OrderedJson value = {{"latitude_deg", shortestDegrees(camera.latitude)},
                       {"longitude_deg", shortestDegrees(camera.longitude)},
                       {"altitude_m", camera.altitude_m},
                       {"heading_deg", shortestDegrees(camera.heading)},
                       {"pitch_deg", shortestDegrees(camera.pitch)},
                       {"roll_deg", shortestDegrees(camera.roll)}};
  if (camera.orthographicHeight_m) {
    value["projection"] = projectionNames().back();
    value["height_m"] = *camera.orthographicHeight_m;
    return value;
  }
  value["projection"] = nameOf(projectionNames(), camera.projection);
  value["fov_deg"] = shortestDegrees(camera.fov);
  return value;
}

OrderedJson terrainJson(const SceneTerrain& terrain) {
  OrderedJson value = {{"height_map", pathText(terrain.heightMap)},
                       {"meters_per_pixel",
                        OrderedJson::array({terrain.metersPerPixel[0], terrain.metersPerPixel[1]})},
                       {"meters_per_unit", terrain.metersPerUnit},
                       {"height_scale", terrain.heightScale},
                       {"base_m", terrain.base_m},
                       {"fade_m", terrain.fade_m},
                       {"latitude_deg", shortestDegrees(terrain.latitude)},
                       {"longitude_deg", shortestDegrees(terrain.longitude)},
                       {"heading_deg", shortestDegrees(terrain.heading)}};
  if (terrain.albedoMap.empty()) {
    value["albedo"] = spectrumJson(terrain.albedo);
  } else {
    value["albedo_map"] = pathText(terrain.albedoMap);
  }
  return value;
}

OrderedJson balloonsJson(const std::vector<SceneBalloon>& balloons) {
  OrderedJson list = OrderedJson::array();
  for (const SceneBalloon& balloon : balloons) {
    list.push_back({{"latitude_deg", shortestDegrees(balloon.latitude)},
                    {"longitude_deg", shortestDegrees(balloon.longitude)},
                    {"altitude_m", balloon.altitude_m},
                    {"radius_m", balloon.radius_m},
                    {"color", spectrumJson(balloon.color)},
                    {"opacity", balloon.opacity}});
  }
  return list;
}

// What is in the picture, and how it is shown; `defaults` has what a file needn't say.
void addPicture(const Scene& scene, const Scene& defaults, OrderedJson* value) {
  OrderedJson& out = *value;
  if (!scene.albedoMap.empty()) out["ground"]["albedo_map"] = pathText(scene.albedoMap);
  if (scene.terrain) out["terrain"] = terrainJson(*scene.terrain);
  if (!scene.balloons.empty()) out["balloons"] = balloonsJson(scene.balloons);
  if (scene.stars) out["stars"]["sidereal_hours"] = scene.stars->siderealHours;
  if (scene.shafts != defaults.shafts) out["shafts"] = nameOf(lightShaftNames(), scene.shafts);
  if (scene.lightShaftStepCount != defaults.lightShaftStepCount)
    out["shaft_samples"] = scene.lightShaftStepCount;
  if (scene.width != defaults.width || scene.height != defaults.height) {
    out["size"] = OrderedJson::array({scene.width, scene.height});
  }
  if (scene.exposure) out["exposure"] = *scene.exposure;
  if (scene.toneMap != defaults.toneMap) out["tone_map"] = nameOf(toneMapNames(), scene.toneMap);
}

void addTables(const Scene& scene, const Scene& defaults, OrderedJson* value) {
  OrderedJson& out = *value;
  if (scene.solver) out["solver"] = nameOf(solverNames(), *scene.solver);
  if (scene.orders) out["orders"] = *scene.orders;
  if (scene.quality && *scene.quality != Quality::Default) {
    out["quality"] = nameOf(qualityNames(), *scene.quality, Quality::Draft);
  }
  if (scene.model != defaults.model) out["model"] = nameOf(modelNames(), scene.model);
  if (scene.modelStepCount) out["model_samples"] = *scene.modelStepCount;
}

void addEffects(const Scene& scene, OrderedJson* value) {
  OrderedJson effects = OrderedJson::object();
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    if (scene.effects[i] == Force::Auto) continue;
    effects[effectName(static_cast<Effect>(i))] = nameOf(forceNames(), scene.effects[i]);
  }
  if (!effects.empty()) (*value)["effects"] = effects;
}

OrderedJson requirementsJson(const SceneRequirements& requirements, const Scene& scene) {
  OrderedJson value = OrderedJson::object();
  const auto addRange = [&](const char* key, const std::optional<double> range[2], double own,
                            double (*shown)(double)) {
    if (!range[0] && !range[1]) return;
    value[key] = OrderedJson::array({shown(range[0].value_or(own)), shown(range[1].value_or(own))});
  };
  addRange("altitude_m", requirements.altitude_m, std::max(scene.camera.altitude_m, 0.0),
           [](double metres) { return metres; });
  addRange("sun_elevation_deg", requirements.sunElevation, scene.sun.elevation, shortestDegrees);
  if (requirements.exposure) value["exposure"] = *requirements.exposure;
  if (requirements.error != 0.0) value["error"] = requirements.error;
  if (requirements.budgetBytes != 0) value["budget_bytes"] = requirements.budgetBytes;
  if (requirements.budgetSeconds != 0.0) value["budget_seconds"] = requirements.budgetSeconds;
  return value;
}

// Empty, or why this path can't be in a file.
std::string pathError(const std::string& path) {
  const std::string absolute = absolutePath(path);
  const std::string shown = asUtf8(absolute);
  if (shown == absolute) return {};
  return "The path '" + shown + "' has bytes that aren't UTF-8; a scene file holds UTF-8 alone.";
}

}  // namespace

std::string formatScene(const Scene& scene) {
  const Scene defaults;
  OrderedJson value;
  value["atmosphere"] = atmosphereOf(scene.atmosphere);
  value["sun"] = sunJson(scene.sun);
  value["camera"] = cameraJson(scene.camera);
  addPicture(scene, defaults, &value);
  addTables(scene, defaults, &value);
  addEffects(scene, &value);
  if (scene.requirements) value["needs"] = requirementsJson(*scene.requirements, scene);
  return formatJson(value);
}

Done writeScene(const std::string& path, const Scene& scene) {
  std::vector<std::string> paths = {scene.albedoMap};
  if (scene.terrain) {
    paths.push_back(scene.terrain->heightMap);
    paths.push_back(scene.terrain->albedoMap);
  }
  for (const std::string& one : paths) {
    if (const std::string error = pathError(one); !error.empty()) return {error};
  }
  const std::string text = formatScene(scene);
  if (const Result<Scene> read = parseScene(text, path, ""); !read) return {read.error};
  return writeFile(path, text.data(), text.size());
}

}  // namespace alpenglow::io
