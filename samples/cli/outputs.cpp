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

void checkOutputs(const RunArguments& arguments) {
  check(io::checkOutput(arguments.output));
  if (arguments.report.empty()) return;
  check(io::checkOutput(arguments.report));
  std::error_code code;
  const std::filesystem::path output = std::filesystem::absolute(arguments.output, code);
  const std::filesystem::path report = std::filesystem::absolute(arguments.report, code);
  if (output.lexically_normal() == report.lexically_normal() &&
      !std::filesystem::is_character_file(output, code)) {
    throw Failure("-o and --report both name '" + arguments.report + "'.", Failure::kUsage);
  }
}

}  // namespace alpenglow::cli
