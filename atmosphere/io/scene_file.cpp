#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/file.h>
#include <alpenglow/io/scene_file.h>
#include <alpenglow/io/table_file.h>

#include <algorithm>
#include <filesystem>

#include "atmosphere/io/atmosphere_json.h"
#include "atmosphere/io/scene_balloons.h"
#include "atmosphere/io/scene_json.h"
#include "atmosphere/io/scene_model.h"
#include "atmosphere/io/scene_terrain.h"

namespace alpenglow::io {

const std::vector<std::string>& projectionNames() {
  static const std::vector<std::string> kNames = {"perspective", "fisheye", "orthographic"};
  return kNames;
}

const std::vector<std::string>& lightShaftNames() {
  static const std::vector<std::string> kNames = {"auto", "paper", "exact", "march", "off"};
  return kNames;
}

const std::vector<std::string>& forceNames() {
  static const std::vector<std::string> kNames = {"auto", "on", "off"};
  return kNames;
}

namespace {

constexpr double kMaxAltitude_m = 1e12;

SceneSun readSun(JsonErrors* errors, const Json& value) {
  ObjectReader reader(errors, value, "sun.", "",
                      {"elevation_deg", "azimuth_deg", "disc_radius_deg"});
  SceneSun sun;
  sun.elevation = radians(reader.number("elevation_deg", -90.0, 90.0));
  sun.azimuth = radians(reader.numberOr("azimuth_deg", 0.0));
  sun.discRadius = radians(reader.numberOr("disc_radius_deg", 0.2667, 0.0, 45.0));
  return sun;
}

double readFov(JsonErrors* errors, ObjectReader* reader, Projection projection) {
  const bool fisheye = projection == Projection::Fisheye;
  const double fov = reader->numberOr("fov_deg", fisheye ? 180.0 : 60.0);
  if (errors->ok() && (fov <= 0.0 || fov > 360.0 || (!fisheye && fov >= 180.0))) {
    reader->wrong("fov_deg", fisheye ? "more than 0 and at most 360 for a fisheye"
                                     : "more than 0 and less than 180 for a perspective");
  }
  return radians(fov);
}

// An orthographic camera has a height in metres, the others an angle.
void readProjection(JsonErrors* errors, ObjectReader* reader, SceneCamera* camera) {
  const size_t choice = reader->choice("projection", projectionNames());
  if (choice < 2) {
    camera->projection = static_cast<Projection>(choice);
    camera->fov = readFov(errors, reader, camera->projection);
    if (reader->has("height_m")) {
      reader->wrong("height_m", "left out, because the projection isn't orthographic");
    }
    return;
  }
  const double height_m = reader->number("height_m");
  if (errors->ok() && !(height_m > 0.0 && height_m <= kMaxAltitude_m)) {
    reader->wrong("height_m", "more than 0 and at most " + showNumber(kMaxAltitude_m));
  }
  if (reader->has("fov_deg")) {
    reader->wrong("fov_deg", "left out, because an orthographic camera has height_m");
  }
  camera->orthographicHeight_m = height_m;
}

SceneCamera readCamera(JsonErrors* errors, const Json& value) {
  ObjectReader reader(errors, value, "camera.", "",
                      {"latitude_deg", "longitude_deg", "altitude_m", "heading_deg", "pitch_deg",
                       "roll_deg", "projection", "fov_deg", "height_m"});
  SceneCamera camera;
  camera.latitude = radians(reader.numberOr("latitude_deg", 0.0, -90.0, 90.0));
  camera.longitude = radians(reader.numberOr("longitude_deg", 0.0));
  camera.altitude_m =
      reader.numberOr("altitude_m", camera.altitude_m, -kMaxAltitude_m, kMaxAltitude_m);
  camera.heading = radians(reader.numberOr("heading_deg", 0.0));
  camera.pitch = radians(reader.numberOr("pitch_deg", 0.0, -90.0, 90.0));
  camera.roll = radians(reader.numberOr("roll_deg", 0.0));
  readProjection(errors, &reader, &camera);
  return camera;
}

}  // namespace

void readAtmosphereOf(JsonErrors* errors, const Json& value, const std::string& folder,
                      Parameters* out) {
  if (value.is_object()) {
    *out = atmosphereFromJson(errors, value, "atmosphere.");
    return;
  }
  const std::string name = value.get<std::string>();
  if (findPreset(name.c_str(), out, {}) == Status::Ok) return;
  const std::string path = relativeTo(folder, name);
  std::error_code code;
  if (!std::filesystem::exists(path, code)) {
    errors->add("field 'atmosphere' is \"" + name + "\"; there is no preset and no file '" + path +
                "' of that name.");
    return;
  }
  const Result<Parameters> parameters = readAtmosphere(path);
  if (!parameters) {
    if (errors->ok()) errors->first = parameters.error;
    return;
  }
  *out = *parameters;
}

namespace {

std::string readGround(JsonErrors* errors, const Json& value, const std::string& folder) {
  ObjectReader reader(errors, value, "ground.", "", {"albedo_map"});
  if (!reader.given("albedo_map")) return {};
  return pathOf(&reader, "albedo_map", folder);
}

void readSize(JsonErrors* errors, ObjectReader* reader, Scene* scene) {
  if (!reader->has("size")) return;
  const Json& size = reader->required("size");
  uint32_t sides[2] = {};
  bool good = size.is_array() && size.size() == 2;
  for (size_t i = 0; good && i < 2; ++i) {
    good = size[i].is_number_unsigned() && size[i].get<uint64_t>() >= 1 &&
           size[i].get<uint64_t>() <= kMaxPictureSide;
    if (good) sides[i] = size[i].get<uint32_t>();
  }
  if (!good) {
    reader->wrong("size",
                  "[width, height], whole numbers from 1 to " + std::to_string(kMaxPictureSide));
  }
  if (!errors->ok()) return;
  scene->width = sides[0];
  scene->height = sides[1];
}

std::optional<double> readExposure(ObjectReader* reader) {
  if (!reader->has("exposure")) return std::nullopt;
  const Json& value = reader->required("exposure");
  if (value == "auto") return std::nullopt;
  if (value.is_number() && value.get<double>() > 0.0) return value.get<double>();
  reader->wrong("exposure", "\"auto\" or a number above 0");
  return std::nullopt;
}

// Null leaves each to its default.
void readTableChoices(ObjectReader* reader, Scene* scene) {
  if (reader->given("solver")) {
    scene->solver = findSolver(solverNames()[reader->choice("solver", solverNames())]);
  }
  if (reader->given("orders")) scene->orders = reader->integer("orders", 1, kMaxOrders);
  if (reader->given("quality")) {
    scene->quality = findQuality(qualityNames()[reader->choice("quality", qualityNames())]);
  }
}

void readEffects(JsonErrors* errors, const Json& value, Scene* scene) {
  ObjectReader effects(errors, value, "effects.", "",
                       {"rayleigh", "mie", "absorption", "multiple_scattering", "ground_reflection",
                        "ground_irradiance", "ground", "sun_disc", "aerial_perspective",
                        "light_shafts", "space_views", "twilight", "night"});
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    const char* name = effectName(static_cast<Effect>(i));
    scene->effects[i] = static_cast<Force>(effects.choice(name, forceNames()));
  }
}

// [from, to], which must hold the scene's own value.
void readRange(ObjectReader* reader, const char* key, double least, double most, double own,
               std::optional<double> out[2]) {
  if (!reader->has(key)) return;
  const Json& range = reader->required(key);
  bool good = range.is_array() && range.size() == 2;
  for (size_t i = 0; good && i < 2; ++i) {
    good =
        range[i].is_number() && range[i].get<double>() >= least && range[i].get<double>() <= most;
    if (good) out[i] = range[i].get<double>();
  }
  good = good && *out[0] <= own && own <= *out[1];
  if (!good) {
    reader->wrong(key, "[from, to] from " + showNumber(least) + " to " + showNumber(most) +
                           ", and hold the scene's own " + showNumber(own));
  }
}

SceneRequirements readRequirements(JsonErrors* errors, const Json& value, const Scene& scene) {
  ObjectReader reader(
      errors, value, "needs.", "",
      {"altitude_m", "sun_elevation_deg", "exposure", "error", "budget_bytes", "budget_seconds"});
  SceneRequirements requirements;
  readRange(&reader, "altitude_m", 0.0, kMaxAltitude_m, std::max(scene.camera.altitude_m, 0.0),
            requirements.altitude_m);
  readRange(&reader, "sun_elevation_deg", -90.0, 90.0, shortestDegrees(scene.sun.elevation),
            requirements.sunElevation);
  for (std::optional<double>& angle : requirements.sunElevation)
    if (angle) angle = radians(*angle);
  if (reader.has("exposure")) requirements.exposure = reader.number("exposure", 1e-12, 1e12);
  requirements.error = reader.numberOr("error", 0.0, 1e-4, 1.0);
  requirements.budgetBytes = static_cast<uint64_t>(reader.numberOr("budget_bytes", 0.0, 1.0, 1e15));
  requirements.budgetSeconds = reader.numberOr("budget_seconds", 0.0, 1e-6, 1e9);
  return requirements;
}

void readLightShafts(JsonErrors* errors, ObjectReader* reader, Scene* scene) {
  scene->shafts = static_cast<SceneLightShafts>(reader->choice("shafts", lightShaftNames()));
  if (reader->has("shaft_samples")) {
    scene->lightShaftStepCount = reader->integer("shaft_samples", 1, kMaxLightShaftSteps);
  }
  if (reader->has("effects")) {
    readEffects(errors, reader->required("effects"), scene);
    const Force shafts = scene->effects[static_cast<uint32_t>(Effect::LightShafts)];
    if (shafts == Force::Off) scene->shafts = SceneLightShafts::Off;
  }
}

// true: those of sidereal time 0.
std::optional<SceneStars> readStars(JsonErrors* errors, ObjectReader* reader) {
  const Json& value = reader->required("stars");
  if (value.is_boolean()) {
    return value.get<bool>() ? std::optional<SceneStars>(SceneStars{}) : std::nullopt;
  }
  if (!value.is_object()) {
    reader->wrong("stars", "true, false, null or an object with sidereal_hours");
    return std::nullopt;
  }
  ObjectReader stars(errors, value, "stars.", "", {"sidereal_hours"});
  return SceneStars{stars.numberOr("sidereal_hours", 0.0, -1e6, 1e6)};
}

}  // namespace

Scene sceneFromJson(JsonErrors* errors, const Json& value, const std::string& folder) {
  ObjectReader reader(errors, value, "", "",
                      {"atmosphere", "sun", "camera", "ground", "terrain", "balloons", "stars",
                       "size", "exposure", "tone_map", "model", "model_samples", "solver", "orders",
                       "quality", "shafts", "shaft_samples", "effects", "needs"});
  Scene scene;
  const Json& atmosphere = reader.required("atmosphere");
  const Json& sun = reader.required("sun");
  const Json& camera = reader.required("camera");
  if (!errors->ok()) return scene;
  if (!atmosphere.is_string() && !atmosphere.is_object()) {
    reader.wrong("atmosphere", "a preset's name, a file's name or an object");
    return scene;
  }
  readAtmosphereOf(errors, atmosphere, folder, &scene.atmosphere);
  scene.sun = readSun(errors, sun);
  scene.camera = readCamera(errors, camera);
  if (reader.given("ground")) {
    scene.albedoMap = readGround(errors, reader.required("ground"), folder);
  }
  if (reader.given("terrain")) {
    scene.terrain = readTerrain(errors, reader.required("terrain"), folder, scene.camera,
                                scene.atmosphere.groundAlbedo);
  }
  if (reader.given("balloons")) {
    scene.balloons = readBalloons(errors, reader.required("balloons"));
  }
  if (reader.given("stars")) scene.stars = readStars(errors, &reader);
  readSize(errors, &reader, &scene);
  scene.exposure = readExposure(&reader);
  scene.toneMap = static_cast<ToneMap>(reader.choice("tone_map", toneMapNames()));
  readTableChoices(&reader, &scene);
  readModel(errors, &reader, &scene);
  readLightShafts(errors, &reader, &scene);
  if (reader.given("needs"))
    scene.requirements = readRequirements(errors, reader.required("needs"), scene);
  return scene;
}

namespace {

Result<Scene> sceneOrError(const Json& value, const std::string& name, const std::string& folder) {
  JsonErrors errors{name, {}};
  Scene scene = sceneFromJson(&errors, value, folder);
  if (!errors.ok()) return Result<Scene>::failure(errors.first);
  return scene;
}

std::string folderOf(const std::string& path) {
  return std::filesystem::path(path).parent_path().string();
}

}  // namespace

Result<Scene> parseScene(const std::string& text, const std::string& name,
                         const std::string& folder) {
  const Result<Json> value = parseJson(text, name);
  if (!value) return Result<Scene>::failure(value.error);
  return sceneOrError(*value, name, folder);
}

Result<Scene> readScene(const std::string& path) {
  const Result<Json> value = readJson(path);
  if (!value) return Result<Scene>::failure(value.error);
  return sceneOrError(*value, path, folderOf(path));
}

Result<AtmosphereSource> findAtmosphereOrScene(const std::string& nameOrPath) {
  using Found = Result<AtmosphereSource>;
  AtmosphereSource source;
  if (findPreset(nameOrPath.c_str(), &source.parameters, {}) == Status::Ok) return source;
  std::error_code code;
  if (!std::filesystem::exists(nameOrPath, code)) {
    return Found::failure("There is no preset and no file named '" + nameOrPath +
                          "'; 'alpenglow presets' lists the presets.");
  }
  const Result<Json> value = readJson(nameOrPath);
  if (!value) return Found::failure(value.error);
  const bool isScene = value->is_object() && (value->contains("atmosphere") ||
                                              value->contains("camera") || value->contains("sun"));
  if (isScene) {
    Result<Scene> scene = sceneOrError(*value, nameOrPath, folderOf(nameOrPath));
    if (!scene) return Found::failure(scene.error);
    source.parameters = scene->atmosphere;
    source.scene = std::move(*scene);
    return source;
  }
  JsonErrors errors{nameOrPath, {}};
  source.parameters = atmosphereFromJson(&errors, *value, "");
  if (!errors.ok()) return Found::failure(errors.first);
  return source;
}

}  // namespace alpenglow::io
