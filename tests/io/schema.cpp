#include "schema.h"

#include <fstream>
#include <set>

namespace alpenglow::test {
namespace {

using Json = nlohmann::json;

Json load(const std::string& path) {
  std::ifstream stream(path);
  return Json::parse(stream);
}

class Checker {
 public:
  explicit Checker(std::string folder) : folder_(std::move(folder)) {}

  std::string check(const Json& root, const Json& schema, const Json& value,
                    const std::string& at) const {
    if (schema.is_boolean()) return schema.get<bool>() ? "" : at + ": must not be there";
    for (const auto& item : schema.items()) {
      const std::string error = keyword(root, schema, item.key(), item.value(), value);
      if (!error.empty()) return error[0] == '@' ? at + error.substr(1) : at + ": " + error;
    }
    return {};
  }

 private:
  static bool isType(const std::string& type, const Json& value) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "null") return value.is_null();
    if (type == "number") return value.is_number();
    return type == "integer" && value.is_number_integer();
  }

  std::string keyword(const Json& root, const Json& schema, const std::string& key,
                      const Json& rule, const Json& value) const {
    static const std::set<std::string> kNotes = {"$schema", "$id",         "$defs", "title",
                                                 "default", "description", "then",  "else"};
    if (kNotes.count(key) != 0) return {};
    if (key == "type") {
      bool any = rule.is_string() && isType(rule, value);
      for (const Json& one : rule.is_array() ? rule : Json::array())
        any = any || isType(one, value);
      return any ? "" : value.dump() + " is not of type " + rule.dump();
    }
    if (key == "const") return value == rule ? "" : value.dump() + " is not " + rule.dump();
    if (key == "enum") {
      for (const Json& one : rule) {
        if (one == value) return {};
      }
      return value.dump() + " is not in " + rule.dump();
    }
    if (key == "$ref") return reference(root, rule, value);
    if (key == "anyOf" || key == "oneOf") return alternatives(root, key, rule, value);
    if (key == "if") {
      const char* branch = check(root, rule, value, "").empty() ? "then" : "else";
      const std::string error = check(root, schema.value(branch, Json(true)), value, "");
      return error.empty() ? "" : "@" + error;
    }
    if (key == "minLength") {
      const bool good = !value.is_string() || value.get<std::string>().size() >= rule.get<size_t>();
      return good ? "" : "the string is too short";
    }
    if (value.is_number()) return bound(key, rule, value.get<double>());
    return members(root, schema, key, rule, value);
  }

  std::string reference(const Json& root, const std::string& target, const Json& value) const {
    const std::string local = "#/$defs/";
    if (target.rfind(local, 0) == 0) {
      const Json& part = root.at("$defs").at(target.substr(local.size()));
      const std::string error = check(root, part, value, "");
      return error.empty() ? "" : "@" + error;
    }
    const Json other = load(folder_ + "/" + target);
    const std::string error = check(other, other, value, "");
    return error.empty() ? "" : "@" + error;
  }

  std::string alternatives(const Json& root, const std::string& key, const Json& rule,
                           const Json& value) const {
    int good = 0;
    std::string errors;
    for (const Json& one : rule) {
      const std::string error = check(root, one, value, "");
      good += error.empty() ? 1 : 0;
      errors += "(" + error + ")";
    }
    if (good == 1 || (good > 1 && key == "anyOf")) return {};
    return std::to_string(good) + " of " + key + " fit " + errors;
  }

  static std::string bound(const std::string& key, const Json& rule, double value) {
    const bool good = key == "minimum"            ? value >= rule.get<double>()
                      : key == "maximum"          ? value <= rule.get<double>()
                      : key == "exclusiveMinimum" ? value > rule.get<double>()
                      : key == "exclusiveMaximum" ? value < rule.get<double>()
                                                  : isStructural(key);
    return good ? "" : std::to_string(value) + " breaks " + key + " " + rule.dump();
  }

  static bool isStructural(const std::string& key) {
    static const std::set<std::string> kKnown = {
        "required", "properties", "additionalProperties", "items",           "minItems", "maxItems",
        "minimum",  "maximum",    "exclusiveMinimum",     "exclusiveMaximum"};
    return kKnown.count(key) != 0;
  }

  std::string members(const Json& root, const Json& schema, const std::string& key,
                      const Json& rule, const Json& value) const {
    if (!isStructural(key)) return "the keyword " + key + " is unknown to this checker";
    if (value.is_array()) {
      if (key == "minItems" && value.size() < rule.get<size_t>()) return "too few items";
      if (key == "maxItems" && value.size() > rule.get<size_t>()) return "too many items";
      for (size_t i = 0; key == "items" && i < value.size(); ++i) {
        const std::string error = check(root, rule, value[i], "/" + std::to_string(i));
        if (!error.empty()) return "@" + error;
      }
    }
    if (!value.is_object()) return {};
    for (const Json& name : key == "required" ? rule : Json::array()) {
      if (!value.contains(name)) return name.dump() + " is missing";
    }
    for (const auto& item : value.items()) {
      const bool known = schema.value("properties", Json::object()).contains(item.key());
      if (key == "additionalProperties" && !known) return "'" + item.key() + "' is unknown";
      if (key != "properties" || !known) continue;
      const std::string error = check(root, rule.at(item.key()), item.value(), "/" + item.key());
      if (!error.empty()) return "@" + error;
    }
    return {};
  }

  std::string folder_;
};

}  // namespace

std::string schemaError(const std::string& folder, const std::string& name,
                        const nlohmann::json& value) {
  const Json schema = load(folder + "/" + name);
  return Checker(folder).check(schema, schema, value, "");
}

}  // namespace alpenglow::test
