// Drawing one picture of a scene into host memory.
#pragma once

#include <alpenglow/io/image_file.h>
#include <alpenglow/io/scene_file.h>

#include "session.h"

namespace alpenglow::cli {

/// Draws at the scene's size: linear radiance for the atmosphere's solar irradiance. `albedo` may
/// be null. Throws a Failure.
io::LinearImage drawScene(Session* session, const io::Scene& scene, const io::AlbedoMap* albedo,
                          const Tables* tables, MieStorage mie);

}  // namespace alpenglow::cli
