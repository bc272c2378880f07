#include "outputs.h"

#include <alpenglow/io/file.h>

#include <algorithm>
#include <filesystem>

#include "failure.h"

namespace alpenglow::cli {

bool hasEnding(const std::string& path, const std::string& ending) {
  return path.size() > ending.size() &&
         path.compare(path.size() - ending.size(), ending.size(), ending) == 0;
}

void checkEnding(const std::string& path, const std::vector<std::string>& endings) {
  std::string list;
  for (const std::string& ending : endings) {
    if (hasEnding(path, ending)) return;
    list += (list.empty() ? "" : " or ") + ending;
  }
  throw Failure("The output '" + path + "' has another ending than " + list + ".", Failure::kUsage);
}

namespace {

// By whatever links lead there; devices and pipes may be both.
bool sameFile(const std::string& a, const std::string& b) {
  std::error_code code;
  return std::filesystem::is_regular_file(a, code) && std::filesystem::equivalent(a, b, code);
}

void checkNoInput(const char* option, const std::string& output,
                  const std::vector<std::string>& inputs) {
  for (const std::string& input : inputs) {
    if (input.empty() || !sameFile(output, input)) continue;
    throw Failure(std::string(option) + " names '" + output + "', which is the input '" + input +
                      "' and would be overwritten.",
                  Failure::kUsage);
  }
}

}  // namespace

std::vector<std::string> inputsOf(const io::Scene& scene) {
  std::vector<std::string> inputs = {scene.albedoMap};
  if (scene.terrain) {
    inputs.push_back(scene.terrain->heightMap);
    inputs.push_back(scene.terrain->albedoMap);
  }
  return inputs;
}

void checkOutputs(const RunArguments& arguments, const std::vector<std::string>& inputs) {
  checkNoInput("-o", arguments.output, inputs);
  checkNoInput("--report", arguments.report, inputs);
  check(io::checkOutput(arguments.output));
  if (arguments.report.empty()) return;
  check(io::checkOutput(arguments.report));
  std::error_code code;
  const std::filesystem::path output = std::filesystem::absolute(arguments.output, code);
  const std::filesystem::path report = std::filesystem::absolute(arguments.report, code);
  const bool same = output.lexically_normal() == report.lexically_normal() &&
                    !std::filesystem::is_character_file(output, code);
  if (same || sameFile(arguments.output, arguments.report)) {
    throw Failure("-o and --report both name '" + arguments.report + "'.", Failure::kUsage);
  }
}

}  // namespace alpenglow::cli
