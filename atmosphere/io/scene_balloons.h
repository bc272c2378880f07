// The field "balloons" of scene files.
#pragma once

#include <alpenglow/io/scene_file.h>

#include <vector>

#include "atmosphere/io/json.h"

namespace alpenglow::io {

/// Reads and checks the field, a list.
std::vector<SceneBalloon> readBalloons(JsonErrors* errors, const Json& value);

}  // namespace alpenglow::io
