// The field "terrain" of scene files, and paths in them.
#pragma once

#include <alpenglow/io/scene_file.h>

#include <string>

#include "atmosphere/io/json.h"

namespace alpenglow::io {

/// A path in a file of `folder` as one that can be opened from here.
std::string relativeTo(const std::string& folder, const std::string& path);
/// The field's string as such a path; empty stays empty.
std::string pathOf(ObjectReader* reader, const char* key, const std::string& folder);

/// Reads and checks the field; it lies at the camera and has the ground's albedo where it doesn't
/// say otherwise. The files it names aren't opened.
SceneTerrain readTerrain(JsonErrors* errors, const Json& value, const std::string& folder,
                         const SceneCamera& camera, const Spectrum& groundAlbedo);

}  // namespace alpenglow::io
