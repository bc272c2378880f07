// The sample scenes and flythroughs, by name.
#pragma once

#include <string>

namespace alpenglow::samples {

/// The path of a scene or flythrough from the command line: a sample's if one has this name, else
/// the name itself, if there is such a file. `kind` is "scenes" or "flythroughs", the folder of
/// these, which is looked for in $ALPENGLOW_DATA_DIR, beside the installed program and in the
/// source tree.
std::string findSample(const std::string& kind, const std::string& nameOrPath);

/// A folder of data by its name, beside the sample scenes, or `otherwise`.
std::string findData(const std::string& name, const std::string& otherwise);

}  // namespace alpenglow::samples
