// Names of solvers and qualities, and the moment solver's settings as text.
#include <algorithm>
#include <cstddef>

#include <alpenglow/table_limits.h>
#include "atmosphere/io/table_format.h"

namespace alpenglow::io {
namespace {

struct Field {
  const char* name;
  uint32_t TableSizes::*member;
  uint32_t most;
};

// The names that files and the command line have.
constexpr Field kFields[] = {{"depthMu", &TableSizes::depthMu, kMaxTableSide},
                             {"depthH", &TableSizes::depthH, kMaxTableSide},
                             {"nodesR", &TableSizes::nodesR, kMaxTableSide},
                             {"nodesMuS", &TableSizes::nodesMuS, kMaxTableSide},
                             {"ringsSky", &TableSizes::zenithsSky, kMaxTableSide},
                             {"ringsLimb", &TableSizes::zenithsLimb, kMaxTableSide},
                             {"ringsGround", &TableSizes::zenithsGround, kMaxTableSide},
                             {"azimuths", &TableSizes::azimuths, kMaxTableSide},
                             {"degree", &TableSizes::degree, kMaxDegree},
                             {"sourceGamma", &TableSizes::sourceGamma, kMaxTableSide},
                             {"sourcePsi", &TableSizes::sourcePsi, kMaxTableSide},
                             {"solverPanels", &TableSizes::solverPanels, kMaxTableSide},
                             {"viewPanels", &TableSizes::viewPanels, kMaxTableSide}};
static_assert(offsetof(TableSizes, transmittanceMu) == std::size(kFields) * sizeof(uint32_t),
              "every field of the moment solver has its name");

constexpr uint32_t kLeastSetting = 2;

std::string range(const Field& field) {
  return "a whole number from " + std::to_string(kLeastSetting) + " to " +
         std::to_string(field.most);
}

// 0 when the string is no whole number of at most 9 digits.
uint32_t wholeNumber(const std::string& text) {
  const bool good = !text.empty() && text.size() <= 9 &&
                    text.find_first_not_of("0123456789") == std::string::npos;
  return good ? static_cast<uint32_t>(std::stoul(text)) : 0;
}

Done parseSetting(const std::string& text, TableSizes* settings) {
  const size_t equals = std::min(text.find('='), text.size());
  const std::string name = text.substr(0, equals);
  const std::string value = text.substr(std::min(equals + 1, text.size()));
  const auto field =
      std::find_if(std::begin(kFields), std::end(kFields), [&](auto& f) { return name == f.name; });
  if (field == std::end(kFields)) {
    std::string names;
    for (const Field& known : kFields)
      names += (names.empty() ? "" : ", ") + std::string(known.name);
    return {"'" + text + "' doesn't start with a moment setting and '='; the settings are " +
            names + "."};
  }
  uint32_t& member = settings->*field->member;
  if (member != 0) return {"The moment setting " + name + " is given twice."};
  const uint32_t number = wholeNumber(value);
  if (number < kLeastSetting || number > field->most) {
    return {"The moment setting " + name + " is '" + value + "', but must be " + range(*field) +
            "."};
  }
  member = number;
  return {};
}

size_t indexOf(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<size_t>(std::find(names.begin(), names.end(), name) - names.begin());
}

}  // namespace

const std::vector<std::string>& solverNames() {
  static const std::vector<std::string> kNames = {"moments", "standard"};
  return kNames;
}

std::string solverName(Solver solver) { return solverNames().at(static_cast<size_t>(solver)); }

std::optional<Solver> findSolver(const std::string& name) {
  const size_t index = indexOf(solverNames(), name);
  if (index == solverNames().size()) return std::nullopt;
  return static_cast<Solver>(index);
}

const std::vector<std::string>& qualityNames() {
  static const std::vector<std::string> kNames = {"draft", "low", "medium", "high", "ultra"};
  return kNames;
}

std::string qualityName(Quality quality) {
  return qualityNames().at(static_cast<size_t>(quality) - static_cast<size_t>(Quality::Draft));
}

std::optional<Quality> findQuality(const std::string& name) {
  const size_t index = indexOf(qualityNames(), name);
  if (index == qualityNames().size()) return std::nullopt;
  return static_cast<Quality>(index + static_cast<size_t>(Quality::Draft));
}

std::string momentSettingsText(const TableSizes& settings) {
  std::string text;
  for (const Field& field : kFields) {
    const uint32_t value = settings.*field.member;
    if (value == 0) continue;
    text += (text.empty() ? "" : ",") + std::string(field.name) + "=" + std::to_string(value);
  }
  return text;
}

Done parseMomentSettings(const std::string& text, TableSizes* settings) {
  TableSizes given;
  for (size_t start = 0; start <= text.size();) {
    const size_t end = std::min(text.find(',', start), text.size());
    if (Done done = parseSetting(text.substr(start, end - start), &given); !done) return done;
    start = end + 1;
  }
  for (const Field& field : kFields) {
    if (given.*field.member != 0) settings->*field.member = given.*field.member;
  }
  return {};
}

Done checkMomentSettings(const TableSizes& settings) {
  for (const Field& field : kFields) {
    const uint32_t value = settings.*field.member;
    if (value >= kLeastSetting && value <= field.most) continue;
    return {"The moment setting " + std::string(field.name) + " is " + std::to_string(value) +
            ", but must be " + range(field) + "."};
  }
  return {};
}

}  // namespace alpenglow::io
