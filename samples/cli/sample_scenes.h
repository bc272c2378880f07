// The sample scenes, by name.
#pragma once

#include <string>

namespace alpenglow::cli {

/// The path of a SCENE from the command line: a sample scene's if one has this name, else the name
/// itself, if there is such a file. Scenes are looked for in $ALPENGLOW_DATA_DIR/scenes, beside the
/// installed program and in the source tree.
std::string findScene(const std::string& nameOrPath);

/// A folder of data by its name, beside the sample scenes, or `otherwise`.
std::string findData(const std::string& name, const std::string& otherwise);

}  // namespace alpenglow::cli
