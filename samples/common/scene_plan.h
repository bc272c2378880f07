// The plan of a scene: its request, and the result.
#pragma once

#include <alpenglow/io/scene_file.h>
#include <alpenglow/plan.h>

namespace alpenglow::samples {

/// Projection of a scene's camera.
Projection projectionOf(const io::SceneCamera& camera);

/// Throws a Failure for what the samples don't draw: triangles with a fisheye camera, stars with a
/// simpler model.
void checkScenery(const io::Scene& scene);

/// Camera, sun and viewport of a scene's picture.
FrameDesc describeDraw(const io::Scene& scene);

/// The request of a scene: all of its SceneRequirements, or, for a still picture, its camera and
/// sun and what is visible.
PlanRequest requestOf(const io::Scene& scene);

/// The same for a camera and a sun that may go anywhere.
PlanRequest requestOfFlight(const io::Scene& scene);

/// Throws a Failure for a request that contradicts itself.
Plan planScene(const io::Scene& scene, const TableDesc& tables);

/// The same of another request.
Plan planRequest(const io::Scene& scene, const PlanRequest& request);

/// The description that a scene's plan starts from: what the scene says of its tables.
TableDesc tablesOf(const io::Scene& scene);

}  // namespace alpenglow::samples
