// What is checked about outputs before any work, so that no bake is lost to a name.
#pragma once

#include <string>
#include <vector>

#include "arguments.h"

namespace alpenglow::cli {

bool hasEnding(const std::string& path, const std::string& ending);

/// Throws a usage Failure unless the path ends in one of these, such as ".exr".
void checkEnding(const std::string& path, const std::vector<std::string>& endings);

/// Throws a Failure unless the output and the report can be written and differ.
void checkOutputs(const RunArguments& arguments);

}  // namespace alpenglow::cli
