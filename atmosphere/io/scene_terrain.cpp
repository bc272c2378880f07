#include "atmosphere/io/scene_terrain.h"

#include <filesystem>

namespace alpenglow::io {
namespace {

constexpr double kMaxLength_m = 1e9;

void readMetersPerPixel(JsonErrors* errors, ObjectReader* reader, double out[2]) {
  const Json& value = reader->required("meters_per_pixel");
  if (!errors->ok()) return;
  const auto isSpacing = [](const Json& number) {
    return number.is_number() && number.get<double>() > 0.0 && number.get<double>() <= kMaxLength_m;
  };
  const bool pair = value.is_array() && value.size() == 2;
  for (size_t i = 0; i < 2; ++i) {
    const Json& number = pair ? value[i] : value;
    if (!isSpacing(number)) {
      reader->wrong("meters_per_pixel",
                    "a number above 0 and at most " + showNumber(kMaxLength_m) +
                        ", or two of them, from west to east and from north to south");
      return;
    }
    out[i] = number.get<double>();
  }
}

double positiveOr(JsonErrors* errors, ObjectReader* reader, const char* key, double fallback) {
  const double value = reader->numberOr(key, fallback, 0.0, kMaxLength_m);
  if (errors->ok() && !(value > 0.0)) {
    reader->wrong(key, "a number above 0 and at most " + showNumber(kMaxLength_m));
  }
  return value;
}

void readAlbedo(JsonErrors* errors, ObjectReader* reader, const std::string& folder,
                SceneTerrain* terrain) {
  if (reader->has("albedo_map")) {
    terrain->albedoMap = pathOf(reader, "albedo_map", folder);
    if (errors->ok() && terrain->albedoMap.empty()) reader->wrong("albedo_map", "an image's path");
    if (reader->has("albedo")) {
      reader->wrong("albedo", "left out, because albedo_map is there");
    }
  }
  if (!reader->has("albedo")) return;
  terrain->albedo = reader->spectrum("albedo");
  for (const double albedo : terrain->albedo.value) {
    if (errors->ok() && !(albedo >= 0.0 && albedo <= 1.0)) {
      reader->wrong("albedo", "numbers from 0 to 1");
    }
  }
}

}  // namespace

std::string relativeTo(const std::string& folder, const std::string& path) {
  return (std::filesystem::path(folder) / path).string();
}

std::string pathOf(ObjectReader* reader, const char* key, const std::string& folder) {
  const std::string path = reader->string(key);
  return path.empty() ? path : relativeTo(folder, path);
}

SceneTerrain readTerrain(JsonErrors* errors, const Json& value, const std::string& folder,
                         const SceneCamera& camera, const Spectrum& groundAlbedo) {
  ObjectReader reader(
      errors, value, "terrain.", "",
      {"height_map", "meters_per_pixel", "meters_per_unit", "height_scale", "base_m", "fade_m",
       "latitude_deg", "longitude_deg", "heading_deg", "albedo", "albedo_map"});
  SceneTerrain terrain;
  terrain.heightMap = pathOf(&reader, "height_map", folder);
  if (errors->ok() && terrain.heightMap.empty()) reader.wrong("height_map", "an image's path");
  readMetersPerPixel(errors, &reader, terrain.metersPerPixel);
  terrain.metersPerUnit = positiveOr(errors, &reader, "meters_per_unit", 1.0);
  terrain.heightScale = positiveOr(errors, &reader, "height_scale", 1.0);
  terrain.base_m = reader.numberOr("base_m", 0.0, -kMaxLength_m, kMaxLength_m);
  terrain.fade_m = reader.numberOr("fade_m", 0.0, 0.0, kMaxLength_m);
  terrain.latitude = reader.has("latitude_deg")
                         ? radians(reader.number("latitude_deg", -90.0, 90.0))
                         : camera.latitude;
  terrain.longitude =
      reader.has("longitude_deg") ? radians(reader.number("longitude_deg")) : camera.longitude;
  terrain.heading = radians(reader.numberOr("heading_deg", 0.0));
  terrain.albedo = groundAlbedo;
  readAlbedo(errors, &reader, folder, &terrain);
  return terrain;
}

}  // namespace alpenglow::io
