// Scenes inside other files.
#pragma once

#include <alpenglow/io/scene_file.h>

#include <string>

#include "atmosphere/io/json.h"

namespace alpenglow::io {

/// Reads and checks a scene; problems go to `errors`. `folder` is where its paths start.
Scene sceneFromJson(JsonErrors* errors, const Json& value, const std::string& folder);

/// The same of its field "atmosphere", a string or an object.
void readAtmosphereOf(JsonErrors* errors, const Json& value, const std::string& folder,
                      Parameters* out);

}  // namespace alpenglow::io
