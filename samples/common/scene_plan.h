// The plan of a scene: what it may ask for, and what follows from it.
#pragma once

#include <alpenglow/io/scene_file.h>

namespace alpenglow::samples {

/// Projection of a scene's camera.
Projection projectionOf(const io::SceneCamera& camera);

/// Throws a Failure for what the samples don't draw: triangles with a fisheye camera, stars with a
/// simpler model.
void checkScenery(const io::Scene& scene);

/// Camera, sun and viewport of a scene's picture.
SkyDraw describeDraw(const io::Scene& scene);

/// What a scene may ask for: all of SceneNeeds, or, of a still, its camera and sun and what they
/// see.
Needs needsOf(const io::Scene& scene);

/// Those of a camera and a sun that may go anywhere.
Needs needsOfFlight(const io::Scene& scene);

/// Throws a Failure for needs that contradict themselves.
Plan planScene(const io::Scene& scene, const TableDesc& base);

/// The same of other needs.
Plan planNeeds(const io::Scene& scene, const Needs& needs, const TableDesc& base);

/// The description that a scene's plan starts from: what the scene says of its tables.
TableDesc tablesOf(const io::Scene& scene);

}  // namespace alpenglow::samples
