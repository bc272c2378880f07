// Scenes inside other files.
#pragma once

#include <alpenglow/io/scene_file.h>

#include <string>
#include <vector>

#include "atmosphere/io/json.h"

namespace alpenglow::io {

/// Reads and checks a scene; problems go to `errors`. `folder` is where its paths start.
Scene sceneFromJson(JsonErrors* errors, const Json& value, const std::string& folder);

/// The same of its field "atmosphere", a string or an object.
void readAtmosphereOf(JsonErrors* errors, const Json& value, const std::string& folder,
                      Parameters* out);

/// How files spell choices, in the order of their values; "orthographic" comes after Projection's.
const std::vector<std::string>& projectionNames();
const std::vector<std::string>& lightShaftNames();
const std::vector<std::string>& forceNames();

}  // namespace alpenglow::io
