// Drawing one picture of a scene into host memory.
#pragma once

#include <alpenglow/io/image_file.h>
#include <alpenglow/io/scene_file.h>
#include <alpenglow/plan.h>

#include "picture_target.h"
#include "scenery.h"
#include "tables.h"

namespace alpenglow::cli {

/// Draws into `target`, which has the scene's size: linear radiance for the atmosphere's solar
/// irradiance. `albedo`, of the ground, and `scenery` may be null. Throws a Failure.
io::LinearImage drawScene(Session* session, const io::Scene& scene, const io::AlbedoMap* albedo,
                          const ReadyTables& ready, const Plan& plan, const PictureTarget& target,
                          Scenery* scenery);

}  // namespace alpenglow::cli
