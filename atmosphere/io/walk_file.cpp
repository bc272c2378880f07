#include <alpenglow/io/walk_file.h>

#include <cmath>
#include <filesystem>

#include "atmosphere/io/atmosphere_json.h"
#include "atmosphere/io/scene_json.h"
#include "atmosphere/io/walk_path.h"

namespace alpenglow::io {
namespace {

constexpr double kMaxTime_s = 1e6;
constexpr const char* kMoving[] = {"atmosphere", "sun", "camera", "exposure", "stars"};

// `base` with what `patch` gives: objects field by field, all else in its place. A null takes a
// field out, so that it has its default.
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

// Puts what a key gives into the scene of the keys before it.
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

WalkKey readKey(JsonErrors* errors, const Json& value, const std::string& folder, Json* scene) {
  ObjectReader reader(
      errors, value, "", "",
      {"time_s", "caption", "move", "atmosphere", "sun", "camera", "exposure", "stars"});
  WalkKey key;
  key.time_s = reader.number("time_s", 0.0, kMaxTime_s);
  if (reader.has("caption")) key.caption = reader.string("caption");
  key.move = static_cast<WalkMove>(reader.choice("move", {"smooth", "linear", "cut"}));
  if (!errors->ok()) return key;
  applyKey(errors, value, folder, scene);
  if (errors->ok()) key.scene = sceneFromJson(errors, *scene, folder);
  return key;
}

void checkOrder(JsonErrors* errors, const Walk& walk, const WalkKey& key) {
  if (walk.keys.empty()) {
    if (key.time_s != 0.0) {
      errors->add("field 'time_s' is " + showNumber(key.time_s) + "; the first key's must be 0.");
    }
    return;
  }
  const WalkKey& before = walk.keys.back();
  if (!(key.time_s > before.time_s)) {
    errors->add("field 'time_s' is " + showNumber(key.time_s) + "; it must be more than " +
                showNumber(before.time_s) + ", the time of the key before.");
    return;
  }
  if (key.move == WalkMove::Cut) return;
  const std::string between = whatHasNoBetween(before.scene, key.scene);
  if (between.empty()) return;
  errors->add(between + "; there is nothing between the two, so the key's 'move' must be \"cut\".");
}

// What is made once for a walk is made for its first key.
void checkGround(JsonErrors* errors, const Walk& walk, const WalkKey& key) {
  if (walk.keys.empty()) return;
  const Scene& first = walk.keys.front().scene;
  if (!first.terrain && first.balloons.empty()) return;
  if (first.atmosphere.bottomRadius_m == key.scene.atmosphere.bottomRadius_m) return;
  errors->add("field 'atmosphere.bottom_radius_m' changes to " +
              showNumber(key.scene.atmosphere.bottomRadius_m) +
              "; it must stay as it is where the scene has a terrain or balloons.");
}

void readKeys(JsonErrors* errors, const Json& keys, Json scene, const std::string& folder,
              Walk* walk) {
  if (!keys.is_array() || keys.empty() || keys.size() > kMaxWalkKeys) {
    errors->add("field 'keys' must be a list of 1 to " + std::to_string(kMaxWalkKeys) + " keys.");
    return;
  }
  for (size_t i = 0; i < keys.size() && errors->ok(); ++i) {
    errors->where = "key " + std::to_string(i) + ": ";
    WalkKey key = readKey(errors, keys[i], folder, &scene);
    if (errors->ok()) checkOrder(errors, *walk, key);
    if (errors->ok()) checkGround(errors, *walk, key);
    walk->keys.push_back(std::move(key));
  }
  errors->where.clear();
}

Walk walkFromJson(JsonErrors* errors, const Json& value, const std::string& folder) {
  ObjectReader reader(errors, value, "", "", {"title", "frames_per_second", "scene", "keys"});
  Walk walk;
  if (reader.has("title")) walk.title = reader.string("title");
  walk.framesPerSecond = reader.numberOr("frames_per_second", walk.framesPerSecond, 0.001, 1000.0);
  const Json& scene = reader.required("scene");
  const Json& keys = reader.required("keys");
  if (!errors->ok()) return walk;
  errors->where = "the scene: ";
  sceneFromJson(errors, scene, folder);
  errors->where.clear();
  if (!errors->ok()) return walk;
  readKeys(errors, keys, scene, folder, &walk);
  if (!errors->ok()) return walk;
  const double frames = walk.keys.back().time_s * walk.framesPerSecond;
  if (frames >= kMaxWalkFrames) {
    errors->add("the walk has " + showNumber(std::floor(frames) + 1.0) + " frames, at most " +
                std::to_string(kMaxWalkFrames) + " are allowed.");
  }
  return walk;
}

Result<Walk> walkOrError(const Json& value, const std::string& name, const std::string& folder) {
  JsonErrors errors{name, {}};
  Walk walk = walkFromJson(&errors, value, folder);
  if (!errors.ok()) return Result<Walk>::failure(errors.first);
  return walk;
}

}  // namespace

Result<Walk> parseWalk(const std::string& text, const std::string& name,
                       const std::string& folder) {
  const Result<Json> value = parseJson(text, name);
  if (!value) return Result<Walk>::failure(value.error);
  return walkOrError(*value, name, folder);
}

Result<Walk> readWalk(const std::string& path) {
  const Result<Json> value = readJson(path);
  if (!value) return Result<Walk>::failure(value.error);
  return walkOrError(*value, path, std::filesystem::path(path).parent_path().string());
}

}  // namespace alpenglow::io
