// Drawing pictures of a scene into host memory.
#pragma once

#include <alpenglow/io/image_file.h>
#include <alpenglow/io/scene_file.h>
#include <alpenglow/plan.h>

#include <optional>

#include "picture_target.h"
#include "scenery.h"
#include "stars/stars.h"
#include "tables.h"

namespace alpenglow::cli {

struct ViewDeleter {
  Session* session = nullptr;
  void operator()(View* view) const { destroyView(view); }
};
using ViewPointer = std::unique_ptr<View, ViewDeleter>;

/// Writes linear radiance (.exr), or the picture that the scene's exposure and tone map make of it
/// (.png). Throws a Failure.
void writePicture(const std::string& path, const io::Scene& scene, const io::LinearImage& image);

/// Draws pictures of scenes that differ in camera, sun and stars; not in projection. Destroyed
/// before what it is given.
class Painter {
 public:
  /// `albedo`, of the ground, and `scenery` may be null; `tables` are as those that it will draw
  /// with, by a plan that covers all of them. Throws a Failure.
  Painter(Session* session, const io::AlbedoMap* albedo, const ReadyTables& tables,
          const Plan& plan, Scenery* scenery);
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  /// Draws into `target`, which has the scene's size: linear radiance for the atmosphere's solar
  /// irradiance. Throws a Failure.
  io::LinearImage draw(const io::Scene& scene, const Tables* tables, const PictureTarget& target);

 private:
  void drawPlain(const FrameDesc& draw, const headless::Image& target, const RecordFn& stars);

  Session* session_;
  samples::Gpu gpu_;
  Scenery* scenery_;
  Solver solver_;
  samples::Owned<VkSampler> sampler_;
  headless::Image albedo_;
  ViewPointer view_;
  std::optional<samples::Stars> stars_;  ///< Made for the first scene that has any.
};

}  // namespace alpenglow::cli
