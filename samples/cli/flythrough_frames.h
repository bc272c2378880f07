// The pictures of a flythrough, one after the other on one device.
#pragma once

#include "picture.h"

namespace alpenglow::cli {

/// What a flythrough needs besides its scenes. All outlive what is made of it.
struct FlythroughParts {
  Session* session = nullptr;
  const TableArguments* tables = nullptr;
  const io::AlbedoMap* albedo = nullptr;  ///< Of the ground; may be null.
  const SceneryFiles* files = nullptr;
  LightShaftDesc shafts;
};

/// Draws scenes that sceneAt() made of one flythrough. Tables are rebaked only where the atmosphere
/// has changed since the last picture, pipelines rebuilt where the projection or the tables' shape
/// has.
class FlythroughFrames {
 public:
  /// `first` is the flythrough's first scene, `request` the tables of its atmosphere. Throws a
  /// Failure.
  FlythroughFrames(FlythroughParts parts, const io::Scene& first, TableRequest request);

  /// Throws a Failure.
  io::LinearImage draw(const io::Scene& scene);

 private:
  void useTables(const io::Scene& scene);
  void usePainter(const io::Scene& scene);
  Plan planOf(const io::Scene& scene) const;

  FlythroughParts parts_;
  PictureTarget target_;
  TableRequest request_;  ///< Of `air_`.
  Parameters air_;
  std::optional<Projection> projection_;
  std::optional<Scenery> scenery_;
  std::optional<ReadyTables> ready_;
  std::optional<Painter> painter_;  ///< Last: it uses all the others.
};

}  // namespace alpenglow::cli
