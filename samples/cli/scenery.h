// Contents of a scene besides the sky: terrain, its light shafts, balloons.
#pragma once

#include <alpenglow/plan.h>

#include <optional>

#include "light_shaft_choice.h"
#include "picture_target.h"
#include "tables.h"
#include "terrain/landscape.h"

namespace alpenglow::cli {

/// Read before there is a device. Throws.
struct SceneryFiles {
  std::optional<samples::TerrainMesh> mesh;
  std::optional<io::AlbedoMap> albedo;
};
SceneryFiles readScenery(const io::Scene& scene);

using RecordFn = std::function<void(VkCommandBuffer)>;

/// On the device. Destroyed before the session; the files outlive it.
class Scenery {
 public:
  Scenery(Session* session, const io::Scene& scene, const SceneryFiles& files,
          const ReadyTables& tables, const LightShaftDesc& shafts, const Plan& plan);

  void describe(ViewDesc* view) const;
  /// Makes the pipelines that read this view's light shafts. Before draw().
  void follow(const View* view);

  /// Draws everything, the sky too, a pass at a time, into a target in any layout; leaves it in
  /// kColorDrawn. `stars`, if any, records what is behind all but the sky.
  void draw(View* view, const Tables* tables, FrameDesc frame, const headless::Image& target,
            const RecordFn& stars);

  /// Of the pipelines that draw behind it; undefined without depth.
  VkFormat depthFormat() const {
    return landscape_.hasTerrain() ? samples::kDepthFormat : VK_FORMAT_UNDEFINED;
  }

 private:
  void drawLightShafts(View* view);
  void drawInto(const headless::Image& target, const FrameDesc& draw, const char* pass, bool first,
                const RecordFn& record);

  Session* session_;
  samples::Gpu gpu_;
  bool hasAerialPerspective_;
  samples::Landscape landscape_;
};

}  // namespace alpenglow::cli
