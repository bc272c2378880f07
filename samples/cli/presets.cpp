#include <alpenglow/io/atmosphere_file.h>

#include <algorithm>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <span>

#include "commands.h"
#include "failure.h"

namespace alpenglow::cli {
namespace {

void listPresets() {
  uint32_t count = 0;
  const Preset* const first = presets(&count);
  const std::span all(first, count);
  size_t widest = 0;
  for (const Preset& preset : all) widest = std::max(widest, std::strlen(preset.name));
  for (const Preset& preset : all) {
    std::cout << std::left << std::setw(static_cast<int>(widest) + 2) << preset.name
              << preset.description << '\n';
  }
}

}  // namespace

void runPresets(const std::string& name) {
  if (name.empty()) {
    listPresets();
    return;
  }
  Parameters parameters;
  if (findPreset(name.c_str(), &parameters, {}) != Status::Ok) {
    throw Failure("There is no preset named '" + name + "'; 'alpenglow presets' lists them.");
  }
  std::cout << io::formatAtmosphere(parameters);
}

}  // namespace alpenglow::cli
