// What is checked about outputs before any work, so that no bake is lost to a name.
#pragma once

#include <alpenglow/io/scene_file.h>

#include <string>
#include <vector>

#include "arguments.h"

namespace alpenglow::cli {

bool hasEnding(const std::string& path, const std::string& ending);

/// Throws a usage Failure unless the path ends in one of these, such as ".exr".
void checkEnding(const std::string& path, const std::vector<std::string>& endings);

/// Throws a Failure unless the output and the report can be written, differ, and are none of the
/// files that are read, of which those that are empty or don't exist count as none.
void checkOutputs(const RunArguments& arguments, const std::vector<std::string>& inputs);

/// Of a scene: the pictures that it names.
std::vector<std::string> inputsOf(const io::Scene& scene);

}  // namespace alpenglow::cli
