#include "atmosphere/io/scene_balloons.h"

namespace alpenglow::io {
namespace {

constexpr double kMaxLength_m = 1e9;

SceneBalloon readBalloon(JsonErrors* errors, const Json& value, const std::string& prefix) {
  ObjectReader reader(
      errors, value, prefix, "",
      {"latitude_deg", "longitude_deg", "altitude_m", "radius_m", "color", "opacity"});
  SceneBalloon balloon;
  balloon.latitude = radians(reader.number("latitude_deg", -90.0, 90.0));
  balloon.longitude = radians(reader.number("longitude_deg"));
  balloon.altitude_m = reader.number("altitude_m", 0.0, kMaxLength_m);
  balloon.radius_m = reader.numberOr("radius_m", balloon.radius_m, 0.0, kMaxLength_m);
  if (errors->ok() && !(balloon.radius_m > 0.0)) {
    reader.wrong("radius_m", "a number above 0 and at most " + showNumber(kMaxLength_m));
  }
  if (reader.has("color")) balloon.color = reader.spectrum("color");
  for (const double color : balloon.color.value) {
    if (errors->ok() && !(color >= 0.0 && color <= 1.0)) {
      reader.wrong("color", "numbers from 0 to 1");
    }
  }
  balloon.opacity = reader.numberOr("opacity", balloon.opacity, 0.0, 1.0);
  return balloon;
}

}  // namespace

std::vector<SceneBalloon> readBalloons(JsonErrors* errors, const Json& value) {
  std::vector<SceneBalloon> balloons;
  if (!value.is_array() || value.size() > kMaxBalloons) {
    errors->add(
        "field 'balloons' is " +
        (value.is_array() ? "a list of " + std::to_string(value.size()) : std::string("no list")) +
        "; it must be a list of at most " + std::to_string(kMaxBalloons) + " balloons.");
    return balloons;
  }
  for (size_t i = 0; i < value.size() && errors->ok(); ++i) {
    balloons.push_back(readBalloon(errors, value[i], "balloons[" + std::to_string(i) + "]."));
  }
  return balloons;
}

}  // namespace alpenglow::io
