// A host's scene in Alpenglow's sky: terrain that casts light shafts, and translucent balloons. It
// shows what a host does itself and what it asks the library for. A frame, in this order:
//
//   recordFrame()      this frame's camera and sun
//   recordDepth()      the terrain's depth alone
//   recordSkySlice(), recordSunMap(), recordShafts()     the library's
//   a rendering scope with depthAttachment():
//     recordTerrain()  linear radiance, without air
//     recordAir()      the library's: air in front of the terrain
//     recordSky()      the library's: the pixels that are left
//     recordBalloons() each with its own air, blended
#pragma once

#include <alpenglow/io/scene_file.h>
#include <alpenglow/shafts.h>

#include <optional>
#include <vector>

#include "common/gpu.h"
#include "landscape_pipelines.h"
#include "terrain_mesh.h"

namespace alpenglow::samples {

struct LandscapeDesc {
  Context* context = nullptr;
  const Tables* tables = nullptr;  ///< On the same context as those that will be drawn with.
  VkExtent2D size = {};  ///< Of the picture, in pixels.
  VkFormat colorFormat = VK_FORMAT_UNDEFINED;
  Solver solver = Solver::Moments;     ///< As the tables that will be drawn with.
  MieStorage mie = MieStorage::Full;   ///< The same.
  const ShaftsDesc* shafts = nullptr;  ///< Method and samples, the rest is filled in; null: none.
};

class Landscape {
 public:
  /// `mesh` is null where the scene has no terrain: then there is neither depth nor are there
  /// shafts. `albedo` is null for the terrain's uniform albedo. All but `albedo` and `desc` outlive
  /// it. Throws.
  Landscape(const Gpu* gpu, const io::Scene& scene, const TerrainMesh* mesh,
            const io::AlbedoMap* albedo, const LandscapeDesc& desc);
  Landscape(const Landscape&) = delete;
  Landscape& operator=(const Landscape&) = delete;
  ~Landscape();

  /// Draws on a planet of these parameters from now on. Where the ground sphere has another radius
  /// the caller has made the mesh for it and calls uploadVertices() while the device is idle.
  void follow(const Parameters& parameters) { parameters_ = parameters; }
  void uploadVertices();

  bool hasTerrain() const { return mesh_ != nullptr; }
  bool hasBalloons() const { return !balloons_.empty(); }
  Shafts* shafts() const { return shafts_; }

  /// Adds what a view must know: the scene's depth and its shafts.
  void describe(ViewDesc* view) const;
  /// Near and far plane for this camera.
  DepthRange depthRange(const Camera& camera) const;
  /// For recordSunMap and recordShafts, while the landscape lives.
  Casters casters();

  /// Outside rendering scopes, as the next; the other calls draw for the camera and sun given here.
  void recordFrame(VkCommandBuffer commands, const SkyDraw& draw) const;
  /// Leaves the depth image in kDepthRead.
  void recordDepth(VkCommandBuffer commands, const SkyDraw& draw) const;
  void recordTerrain(VkCommandBuffer commands, const Tables* tables, const SkyDraw& draw) const;
  void recordBalloons(VkCommandBuffer commands, const Tables* tables, const SkyDraw& draw) const;

  /// Of the scope of recordTerrain and all after it; null without terrain.
  const VkRenderingAttachmentInfo* depthAttachment() const;

 private:
  void uploadTerrain(const io::SceneTerrain& terrain, const io::AlbedoMap* albedo);
  void makeShafts(const LandscapeDesc& desc);
  void setPicture(VkCommandBuffer commands, const SkyDraw& draw) const;
  void placeTerrain(VkCommandBuffer commands, const SkyDraw& draw) const;
  void drawTerrain(VkCommandBuffer commands, const headless::HostBuffer& indices,
                   size_t count) const;

  const Gpu* gpu_;
  Projection projection_;
  Parameters parameters_;
  std::vector<io::SceneBalloon> balloons_;
  const TerrainMesh* mesh_;
  headless::Image depth_, albedo_;
  VkRenderingAttachmentInfo depthAttachment_ = {};
  headless::HostBuffer vertices_, indices_;
  headless::HostBuffer adjacency_;  ///< Only for the paper's shadow volumes.
  size_t adjacencyCount_ = 0;
  Shafts* shafts_ = nullptr;
  std::optional<LandscapePipelines> pipelines_;  ///< Made once images and shafts are there.
};

}  // namespace alpenglow::samples
