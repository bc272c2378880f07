#include "config.h"

#include <alpenglow/io/file.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "common/failure.h"

namespace alpenglow::view {
namespace {

using Json = nlohmann::json;
using samples::Failure;

class Reader {
 public:
  explicit Reader(const std::string& path) : path_(path) {}

  [[noreturn]] void refuse(const std::string& field, const Json& value,
                           const std::string& expected) const {
    throw Failure("The config file '" + path_ + "' has the " + field + " " + value.dump() +
                  ", but " + expected + " is expected.");
  }

  using Fields = std::map<std::string, std::function<void(const Json&)>>;
  void readObject(const Json& object, const std::string& where, const Fields& fields) const {
    if (!object.is_object()) refuse(where.empty() ? "contents" : where, object, "an object {...}");
    for (const auto& [key, value] : object.items()) {
      const auto found = fields.find(key);
      if (found != fields.end()) {
        found->second(value);
        continue;
      }
      std::string names;
      for (const auto& [name, read] : fields) names += (names.empty() ? "" : ", ") + name;
      throw Failure("The config file '" + path_ + "' has the unknown field '" + where +
                    (where.empty() ? "" : ".") + key + "'; these exist: " + names + ".");
    }
  }

  std::function<void(const Json&)> number(const std::string& field, double least, double most,
                                          double* out) const {
    return [=, this](const Json& value) {
      const double given = value.is_number() ? value.get<double>() : least - 1.0;
      if (!(given >= least && given <= most)) {
        refuse(field, value, "a number from " + Json(least).dump() + " to " + Json(most).dump());
      }
      *out = given;
    };
  }
  std::function<void(const Json&)> flag(const std::string& field, bool* out) const {
    return [=, this](const Json& value) {
      if (!value.is_boolean()) refuse(field, value, "true or false");
      *out = value.get<bool>();
    };
  }
  void readSize(const Json& value, Config* config) const {
    const bool pair = value.is_array() && value.size() == 2 && value[0].is_number_unsigned() &&
                      value[1].is_number_unsigned();
    const auto good = [](const Json& side) { return side >= 64 && side <= 16384; };
    if (!pair || !good(value[0]) || !good(value[1])) {
      refuse("window.size", value, "[width, height], each from 64 to 16384,");
    }
    config->width = value[0];
    config->height = value[1];
  }
  void readKey(const Json& value, Binding* binding) {
    const int key = value.is_string() ? keyNamed(value.get<std::string>()) : 0;
    if (key == 0) {
      refuse("keys." + std::string(binding->name), value,
             "a key such as \"W\", \"7\", \"F1\", \"Left\", \"Space\" or \"LeftShift\"");
    }
    const auto [other, isNew] = given_.emplace(key, binding->name);
    if (!isNew) {
      refuse("keys." + std::string(binding->name), value,
             "another key than that of keys." + other->second);
    }
    binding->key = key;
  }

 private:
  std::map<int, std::string> given_;
  const std::string& path_;
};

}  // namespace

Config readConfig(const std::string& path) {
  const std::string text = samples::take(io::readFile(path, 1 << 20));
  Json json;
  try {
    const auto watch = [&](int depth, Json::parse_event_t, Json&) {
      constexpr int kMaxDepth = 8;
      if (depth <= kMaxDepth) return true;
      throw Failure("The config file '" + path + "' nests deeper than " +
                    std::to_string(kMaxDepth) + " levels.");
    };
    json = Json::parse(text, watch, true, true);  // With comments.
  } catch (const Json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: text".
    const std::string what = error.what();
    const size_t bracket = what.find("] ");
    throw Failure("The config file '" + path + "' is no JSON with comments: " +
                  (bracket == std::string::npos ? what : what.substr(bracket + 2)) + ".");
  }
  Config config;
  Reader reader(path);
  Reader::Fields keys;
  for (Binding& binding : config.bindings) {
    keys[binding.name] = [&](const Json& value) { reader.readKey(value, &binding); };
  }
  const Reader::Fields window = {
      {"size", [&](const Json& value) { reader.readSize(value, &config); }},
      {"vsync", reader.flag("window.vsync", &config.vsync)},
      {"panel", reader.flag("window.panel", &config.panel)},
      {"interface_scale",
       reader.number("window.interface_scale", 0.25, 4.0, &config.interfaceScale)}};
  double bake_ms = 1e3 * config.bakeSeconds;
  reader.readObject(
      json, "",
      {{"window", [&](const Json& value) { reader.readObject(value, "window", window); }},
       {"keys", [&](const Json& value) { reader.readObject(value, "keys", keys); }},
       {"frames_per_second",
        reader.number("frames_per_second", 1.0, 1000.0, &config.framesPerSecond)},
       {"bake_ms", reader.number("bake_ms", 0.1, 1000.0, &bake_ms)}});
  config.bakeSeconds = 1e-3 * bake_ms;
  return config;
}

std::string usualConfig() {
  const char* home = std::getenv("XDG_CONFIG_HOME");
  std::filesystem::path folder = home != nullptr ? home : "";
  if (folder.empty()) {
    home = std::getenv("HOME");
    if (home == nullptr) return "";
    folder = std::filesystem::path(home) / ".config";
  }
  std::error_code code;
  const std::filesystem::path path = folder / "alpenglow" / "view.json";
  return std::filesystem::is_regular_file(path, code) ? path.string() : "";
}

}  // namespace alpenglow::view
