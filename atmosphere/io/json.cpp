#include "atmosphere/io/json.h"

#include <alpenglow/io/file.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>

namespace alpenglow::io {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxDepth = 32;
// A string that starts with this character stands for a number that JSON can't hold.
constexpr char kNotFinite = '\x01';

bool isWordCharacter(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' ||
         c == '-' || c == '.';
}

// By from_chars, since strtod follows the locale. It calls numbers that are too small out of range,
// too: those have a negative exponent or begin with 0.
bool isNotFinite(const std::string& word) {
  if (word == "NaN" || word == "Infinity" || word == "-Infinity") return true;
  const bool small = word.find("e-") != std::string::npos || word.find("E-") != std::string::npos ||
                     word.rfind("0", 0) == 0 || word.rfind("-0", 0) == 0;
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc::result_out_of_range && end == word.data() + word.size() && !small;
}

// nlohmann's parser stops at numbers that are not finite, without saying which field they are in.
// So they are turned into marked strings, which ObjectReader refuses.
std::string markNotFinite(const std::string& text) {
  std::string out;
  out.reserve(text.size());
  bool quoted = false;
  for (size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (quoted && c == '\\' && i + 1 < text.size()) {
      out.append(text, i, 2);
      i += 2;
      continue;
    }
    if (c == '"') quoted = !quoted;
    if (quoted || !isWordCharacter(c)) {
      out += c;
      ++i;
      continue;
    }
    size_t end = i;
    while (end < text.size() && isWordCharacter(text[end])) ++end;
    const std::string word = text.substr(i, end - i);
    out += isNotFinite(word) ? "\"\\u0001" + word + "\"" : word;
    i = end;
  }
  return out;
}

std::string show(const Json& value) {
  if (value.is_string() && !isText(value)) return value.get<std::string>().substr(1, 40);
  if (value.is_object()) return "an object";
  std::string text = value.dump(-1, ' ', true, Json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

// nlohmann's "[json.exception.parse_error.101] parse error at line 1, column 2: text".
std::string parserText(const std::string& what, const std::string& name) {
  const size_t bracket = what.find("] ");
  std::string text = bracket == std::string::npos ? what : what.substr(bracket + 2);
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.size() > 200) text = text.substr(0, 197) + "...";
  return "The file '" + name + "' is not valid JSON: " + text + ".";
}

bool isLeaf(const OrderedJson& value) {
  return !value.is_object() && !(value.is_array() && !value.empty() && value[0].is_object());
}

std::string inlineJson(const OrderedJson& value) {
  if (!value.is_structured()) return value.dump();
  std::string text = value.is_object() ? "{" : "[";
  bool first = true;
  for (const auto& item : value.items()) {
    if (!first) text += ", ";
    first = false;
    if (value.is_object()) text += OrderedJson(item.key()).dump() + ": ";
    text += inlineJson(item.value());
  }
  return text + (value.is_object() ? "}" : "]");
}

void formatInto(const OrderedJson& value, const std::string& indent, bool top, std::string* out) {
  const std::string line = inlineJson(value);
  if (!top && (isLeaf(value) || line.size() + indent.size() <= 96)) {
    *out += line;
    return;
  }
  if (value.empty()) {
    *out += line;
    return;
  }
  *out += value.is_object() ? "{\n" : "[\n";
  bool first = true;
  for (const auto& item : value.items()) {
    if (!first) *out += ",\n";
    first = false;
    *out += indent + "  ";
    if (value.is_object()) *out += OrderedJson(item.key()).dump() + ": ";
    formatInto(item.value(), indent + "  ", false, out);
  }
  *out += "\n" + indent + (value.is_object() ? "}" : "]");
}

std::string range(double least, double most) {
  if (least == -kInfinity && most == kInfinity) return "a finite number";
  if (most == kInfinity) return "a finite number of at least " + showNumber(least);
  return "a number from " + showNumber(least) + " to " + showNumber(most);
}

}  // namespace

double shortestDegrees(double angle) {
  const double exact = angle * (180.0 / kPi);
  for (int digits = 1; digits <= 17; ++digits) {
    char text[40];
    const std::to_chars_result end =
        std::to_chars(text, text + sizeof text, exact, std::chars_format::general, digits);
    double rounded = 0.0;
    std::from_chars(text, end.ptr, rounded);
    if (radians(rounded) == angle) return rounded;
  }
  for (const double neighbour :
       {std::nextafter(exact, kInfinity), std::nextafter(exact, -kInfinity)}) {
    if (radians(neighbour) == angle) return neighbour;
  }
  return exact;
}

std::string showNumber(double value) {
  if (std::isfinite(value) && value == std::floor(value) && std::abs(value) < 1e15) {
    return std::to_string(static_cast<long long>(value));
  }
  return std::isfinite(value) ? Json(value).dump() : std::to_string(value);
}

Result<Json> parseJson(const std::string& text, const std::string& name) {
  std::vector<std::set<std::string>> objects;
  std::string doubled;
  bool tooDeep = false, holdsNul = false;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
    tooDeep = tooDeep || depth > kMaxDepth;
    const bool mayBeText = event == Json::parse_event_t::key || event == Json::parse_event_t::value;
    holdsNul = holdsNul || (mayBeText && parsed.is_string() &&
                            parsed.get_ref<const std::string&>().find('\0') != std::string::npos);
    if (event == Json::parse_event_t::object_start) {
      objects.emplace_back();
    } else if (event == Json::parse_event_t::object_end) {
      objects.pop_back();
    } else if (event == Json::parse_event_t::key) {
      const std::string key = parsed.get<std::string>();
      if (!objects.back().insert(key).second && doubled.empty()) doubled = key;
    }
    return !tooDeep;
  };
  // The parser takes it for the end of the file.
  if (const size_t nul = text.find('\0'); nul != std::string::npos) {
    return Result<Json>::failure("The file '" + name + "' is not valid JSON: byte " +
                                 std::to_string(nul + 1) + " is a NUL character.");
  }
  try {
    Json value = Json::parse(markNotFinite(text), watch);
    if (tooDeep) {
      return Result<Json>::failure("The file '" + name + "' nests deeper than " +
                                   std::to_string(kMaxDepth) + " levels.");
    }
    if (holdsNul) {
      return Result<Json>::failure("The file '" + name +
                                   "' has a string with a NUL character (\\u0000), but names and "
                                   "paths have none.");
    }
    if (!doubled.empty()) {
      return Result<Json>::failure("In '" + name + "', field '" + doubled +
                                   "' stands twice in one object.");
    }
    return value;
  } catch (const Json::exception& problem) {
    return Result<Json>::failure(parserText(problem.what(), name));
  } catch (const std::bad_alloc&) {
    return Result<Json>::failure("There is not enough memory to read '" + name + "'.");
  }
}

Result<Json> readJson(const std::string& path) {
  const Result<std::string> text = readFile(path, kMaxJsonBytes);
  if (!text) return Result<Json>::failure(text.error);
  return parseJson(*text, path);
}

bool isText(const Json& value) {
  if (!value.is_string()) return false;
  const std::string& text = value.get_ref<const std::string&>();
  return text.empty() || text[0] != kNotFinite;
}

std::string formatJson(const OrderedJson& value) {
  std::string text;
  formatInto(value, "", true, &text);
  return text + "\n";
}

ObjectReader::ObjectReader(JsonErrors* errors, const Json& value, std::string prefix,
                           std::string suffix, std::initializer_list<const char*> known)
    : errors_(errors), object_(&value), prefix_(std::move(prefix)), suffix_(std::move(suffix)) {
  static const Json kEmpty = Json::object();
  if (!value.is_object()) {
    const std::string what = !prefix_.empty()
                                 ? "field '" + prefix_.substr(0, prefix_.size() - 1) + "'" + suffix_
                             : suffix_.empty() ? "the top level"
                                               : "the entry" + suffix_;
    errors_->add(what + " is " + show(value) + "; it must be an object.");
    object_ = &kEmpty;
    return;
  }
  for (const auto& item : value.items()) {
    const auto same = [&](const char* key) { return item.key() == key; };
    if (std::any_of(known.begin(), known.end(), same)) continue;
    std::string list;
    for (const char* key : known) list += (list.empty() ? "" : ", ") + std::string(key);
    const std::string shown = show(Json(item.key()));
    errors_->add("field '" + prefix_ + shown.substr(1, shown.size() - 2) + "'" + suffix_ +
                 " is unknown; the fields here are " + list + ".");
    return;
  }
}

bool ObjectReader::has(const char* key) const { return object_->contains(key); }

bool ObjectReader::given(const char* key) const { return has(key) && !object_->at(key).is_null(); }

const Json& ObjectReader::required(const char* key) {
  static const Json kNull;
  if (has(key)) return object_->at(key);
  errors_->add(name(key) + " is missing.");
  return kNull;
}

void ObjectReader::wrong(const char* key, const std::string& mustBe) {
  errors_->add(name(key) + " is " + show(required(key)) + "; it must be " + mustBe + ".");
}

double ObjectReader::finite(const char* key, const Json& value, const std::string& mustBe,
                            double least, double most) {
  if (value.is_number()) {
    const double number = value.get<double>();
    if (std::isfinite(number) && number >= least && number <= most) return number;
  }
  if (has(key)) wrong(key, mustBe);
  return 0.0;
}

double ObjectReader::number(const char* key, double least, double most) {
  return finite(key, required(key), range(least, most), least, most);
}

double ObjectReader::number(const char* key) { return number(key, -kInfinity, kInfinity); }

double ObjectReader::numberOr(const char* key, double fallback, double least, double most) {
  return has(key) ? number(key, least, most) : fallback;
}

double ObjectReader::numberOr(const char* key, double fallback) {
  return numberOr(key, fallback, -kInfinity, kInfinity);
}

Spectrum ObjectReader::spectrum(const char* key) {
  Spectrum result;
  const std::string mustBe = "an array of " + std::to_string(kSpectrumSize) + " finite numbers";
  const Json& value = required(key);
  if (!value.is_array() || value.size() != kSpectrumSize) {
    if (has(key)) wrong(key, mustBe);
    return result;
  }
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    result[i] = finite(key, value[i], mustBe, -kInfinity, kInfinity);
  }
  return result;
}

uint32_t ObjectReader::integer(const char* key, uint32_t least, uint32_t most) {
  const std::string mustBe =
      "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
  const double number = finite(key, required(key), mustBe, least, most);
  if (number != std::floor(number)) wrong(key, mustBe);
  return static_cast<uint32_t>(number);
}

std::string ObjectReader::string(const char* key) {
  const Json& value = required(key);
  if (isText(value)) return value.get<std::string>();
  if (has(key)) wrong(key, "a string");
  return {};
}

size_t ObjectReader::choice(const char* key, const std::vector<std::string>& values) {
  if (!has(key)) return 0;
  const Json& value = object_->at(key);
  const auto found = value.is_string()
                         ? std::find(values.begin(), values.end(), value.get<std::string>())
                         : values.end();
  if (found != values.end()) return static_cast<size_t>(found - values.begin());
  std::string list;
  for (size_t i = 0; i < values.size(); ++i) {
    list += (i == 0 ? "\"" : i + 1 == values.size() ? " or \"" : ", \"") + values[i] + "\"";
  }
  wrong(key, list);
  return 0;
}

}  // namespace alpenglow::io
