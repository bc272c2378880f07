// Reading JSON with sentences: unknown, missing and doubled fields are refused by name, and numbers
// that are not finite arrive at the field that holds them.
#pragma once

#include <alpenglow/io/result.h>
#include <alpenglow/parameters.h>

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace alpenglow::io {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

/// Most bytes of a JSON file that is read.
inline constexpr uint64_t kMaxJsonBytes = uint64_t{16} << 20;

inline constexpr double kPi = 3.14159265358979323846;
inline double radians(double degrees) { return degrees * (kPi / 180.0); }
/// The shortest degrees for which radians() gives back exactly this angle, where there are any (of
/// about ten in eleven doubles, and of all that come from degrees), else those of a neighbouring
/// double, which no other degrees give.
double shortestDegrees(double angle);

/// Parses text; `name` is how sentences call the file. NaN, Infinity and numbers beyond a double
/// become values that ObjectReader refuses with their field's name.
Result<Json> parseJson(const std::string& text, const std::string& name);
Result<Json> readJson(const std::string& path);

/// Whether a value is a string of the file: not a number that JSON can't hold.
bool isText(const Json& value);

/// Text for people: lines of at most about 100 columns, numbers with all their digits.
std::string formatJson(const OrderedJson& value);

/// A number as sentences show it: the shortest digits that read back as the same double.
std::string showNumber(double value);

/// Keeps the first problem found in a file.
struct JsonErrors {
  std::string file;
  std::string first;
  std::string where = {};  ///< The part of the file that is read, such as "key 3: ".
  bool ok() const { return first.empty(); }
  void add(const std::string& text) {
    if (first.empty()) first = "In '" + file + "', " + where + text;
  }
};

/// The fields of one JSON object. A reading function returns a harmless default once something is
/// wrong; look at JsonErrors at the end. `prefix` is put before a field's name in sentences
/// ("sun."), `suffix` after it (" of query 'a'").
class ObjectReader {
 public:
  ObjectReader(JsonErrors* errors, const Json& value, std::string prefix, std::string suffix,
               std::initializer_list<const char*> known);

  /// True when the field is there, null or not.
  bool has(const char* key) const;
  /// True when the field is there and not null.
  bool given(const char* key) const;
  /// The field's value; null, with an error, when it is missing.
  const Json& required(const char* key);

  /// A finite number; `least` and `most` included.
  double number(const char* key, double least, double most);
  double number(const char* key);
  /// The default when the field is absent.
  double numberOr(const char* key, double fallback, double least, double most);
  double numberOr(const char* key, double fallback);
  Spectrum spectrum(const char* key);
  uint32_t integer(const char* key, uint32_t least, uint32_t most);
  std::string string(const char* key);
  /// Index of the field's string among `values`; 0 when the field is absent.
  size_t choice(const char* key, const std::vector<std::string>& values);
  /// Says what is wrong with a field: "field 'x' is 3; it must be ...".
  void wrong(const char* key, const std::string& mustBe);

 private:
  std::string name(const char* key) const { return "field '" + prefix_ + key + "'" + suffix_; }
  double finite(const char* key, const Json& value, const std::string& mustBe, double least,
                double most);

  JsonErrors* errors_;
  const Json* object_;
  std::string prefix_;
  std::string suffix_;
};

}  // namespace alpenglow::io
