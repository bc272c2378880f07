#include <alpenglow/io/flythrough_file.h>

#include <cmath>
#include <filesystem>

#include "atmosphere/io/atmosphere_json.h"
#include "atmosphere/io/flythrough_path.h"
#include "atmosphere/io/scene_json.h"

namespace alpenglow::io {
namespace {

constexpr double kMaxTime_s = 1e6;
constexpr const char* kMoving[] = {"atmosphere", "sun", "camera", "exposure", "stars"};

// `base` with the fields of `patch`: objects are merged field by field, other values replaced. Null
// removes a field, so that it has its default.
Json patched(Json base, const Json& patch) {
  if (!patch.is_object()) return patch;
  if (!base.is_object()) base = Json::object();
  for (const auto& [field, value] : patch.items()) {
    if (value.is_null()) {
      base.erase(field);
    } else {
      base[field] = patched(base[field], value);
    }
  }
  return base;
}

// An atmosphere's fields are all required, and null means something there.
Json patchedAtmosphere(Json base, const Json& patch) {
  if (!patch.is_object()) return patch;
  if (!base.is_object()) base = Json::object();
  for (const auto& [field, value] : patch.items())
    base[field] = patchedAtmosphere(base[field], value);
  return base;
}

// Merges a key's fields into the scene of the keys before it.
void applyKey(JsonErrors* errors, const Json& key, const std::string& folder, Json* scene) {
  for (const char* field : kMoving) {
    if (!key.contains(field)) continue;
    const Json& patch = key[field];
    Json& base = (*scene)[field];
    if (std::string(field) != "atmosphere") {
      base = patched(base, patch);
      continue;
    }
    if (patch.is_object() && base.is_string()) {
      Parameters named;
      readAtmosphereOf(errors, base, folder, &named);
      base = Json::parse(atmosphereToJson(named).dump());
    }
    base = patchedAtmosphere(base, patch);
  }
}

FlythroughKey readKey(JsonErrors* errors, const Json& value, const std::string& folder,
                      Json* scene) {
  ObjectReader reader(
      errors, value, "", "",
      {"time_s", "caption", "move", "atmosphere", "sun", "camera", "exposure", "stars"});
  FlythroughKey key;
  key.time_s = reader.number("time_s", 0.0, kMaxTime_s);
  if (reader.has("caption")) key.caption = reader.string("caption");
  key.move = static_cast<FlythroughMove>(reader.choice("move", {"smooth", "linear", "cut"}));
  if (!errors->ok()) return key;
  applyKey(errors, value, folder, scene);
  if (errors->ok()) key.scene = sceneFromJson(errors, *scene, folder);
  return key;
}

void checkOrder(JsonErrors* errors, const Flythrough& flythrough, const FlythroughKey& key) {
  if (flythrough.keys.empty()) {
    if (key.time_s != 0.0) {
      errors->add("field 'time_s' is " + showNumber(key.time_s) + "; the first key's must be 0.");
    }
    return;
  }
  const FlythroughKey& before = flythrough.keys.back();
  if (!(key.time_s > before.time_s)) {
    errors->add("field 'time_s' is " + showNumber(key.time_s) + "; it must be more than " +
                showNumber(before.time_s) + ", the time of the key before.");
    return;
  }
  if (key.move == FlythroughMove::Cut) return;
  const std::string between = whatHasNoBetween(before.scene, key.scene);
  if (between.empty()) return;
  errors->add(between + "; there is nothing between the two, so the key's 'move' must be \"cut\".");
}

// Things that are made once for a flythrough are made for its first key.
void checkGround(JsonErrors* errors, const Flythrough& flythrough, const FlythroughKey& key) {
  if (flythrough.keys.empty()) return;
  const Scene& first = flythrough.keys.front().scene;
  if (!first.terrain && first.balloons.empty()) return;
  if (first.atmosphere.bottomRadius_m == key.scene.atmosphere.bottomRadius_m) return;
  errors->add("field 'atmosphere.bottom_radius_m' changes to " +
              showNumber(key.scene.atmosphere.bottomRadius_m) +
              "; it must stay as it is where the scene has a terrain or balloons.");
}

void readKeys(JsonErrors* errors, const Json& keys, Json scene, const std::string& folder,
              Flythrough* flythrough) {
  if (!keys.is_array() || keys.empty() || keys.size() > kMaxFlythroughKeys) {
    errors->add("field 'keys' must be a list of 1 to " + std::to_string(kMaxFlythroughKeys) +
                " keys.");
    return;
  }
  for (size_t i = 0; i < keys.size() && errors->ok(); ++i) {
    errors->where = "key " + std::to_string(i) + ": ";
    FlythroughKey key = readKey(errors, keys[i], folder, &scene);
    if (errors->ok()) checkOrder(errors, *flythrough, key);
    if (errors->ok()) checkGround(errors, *flythrough, key);
    flythrough->keys.push_back(std::move(key));
  }
  errors->where.clear();
}

Flythrough flythroughFromJson(JsonErrors* errors, const Json& value, const std::string& folder) {
  ObjectReader reader(errors, value, "", "", {"title", "frames_per_second", "scene", "keys"});
  Flythrough flythrough;
  if (reader.has("title")) flythrough.title = reader.string("title");
  flythrough.framesPerSecond =
      reader.numberOr("frames_per_second", flythrough.framesPerSecond, 0.001, 1000.0);
  const Json& scene = reader.required("scene");
  const Json& keys = reader.required("keys");
  if (!errors->ok()) return flythrough;
  errors->where = "the scene: ";
  sceneFromJson(errors, scene, folder);
  errors->where.clear();
  if (!errors->ok()) return flythrough;
  readKeys(errors, keys, scene, folder, &flythrough);
  if (!errors->ok()) return flythrough;
  const double frames = flythrough.keys.back().time_s * flythrough.framesPerSecond;
  if (frames >= kMaxFlythroughFrames) {
    errors->add("the flythrough has " + showNumber(std::floor(frames) + 1.0) + " frames, at most " +
                std::to_string(kMaxFlythroughFrames) + " are allowed.");
  }
  return flythrough;
}

Result<Flythrough> flythroughOrError(const Json& value, const std::string& name,
                                     const std::string& folder) {
  JsonErrors errors{name, {}};
  Flythrough flythrough = flythroughFromJson(&errors, value, folder);
  if (!errors.ok()) return Result<Flythrough>::failure(errors.first);
  return flythrough;
}

}  // namespace

Result<Flythrough> parseFlythrough(const std::string& text, const std::string& name,
                                   const std::string& folder) {
  const Result<Json> value = parseJson(text, name);
  if (!value) return Result<Flythrough>::failure(value.error);
  return flythroughOrError(*value, name, folder);
}

Result<Flythrough> readFlythrough(const std::string& path) {
  const Result<Json> value = readJson(path);
  if (!value) return Result<Flythrough>::failure(value.error);
  return flythroughOrError(*value, path, std::filesystem::path(path).parent_path().string());
}

}  // namespace alpenglow::io
