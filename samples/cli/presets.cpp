#include <alpenglow/io/atmosphere_file.h>

#include <algorithm>
#include <cstring>
#include <iomanip>
#include <iostream>

#include "commands.h"
#include "failure.h"

namespace alpenglow::cli {
namespace {

void listPresets() {
  size_t widest = 0;
  for (uint32_t i = 0; i < presetCount(); ++i) {
    widest = std::max(widest, std::strlen(presetName(i)));
  }
  for (uint32_t i = 0; i < presetCount(); ++i) {
    std::cout << std::left << std::setw(static_cast<int>(widest) + 2) << presetName(i)
              << presetDescription(i) << '\n';
  }
}

}  // namespace

void runPresets(const std::string& name) {
  if (name.empty()) {
    listPresets();
    return;
  }
  Parameters parameters;
  if (findPreset(name.c_str(), &parameters) != Status::Ok) {
    throw Failure("There is no preset named '" + name + "'; 'alpenglow presets' lists them.");
  }
  std::cout << io::formatAtmosphere(parameters);
}

}  // namespace alpenglow::cli
