// A host's scene in Alpenglow's sky: terrain that casts light shafts, and translucent balloons. It
// shows which steps are the host's and which the library's. A frame, in this order:
//
//   recordFrame()      this frame's camera and sun
//   recordDepth()      the terrain's depth alone
//   beginFrame(), recordLuts(), recordShadowMap(), recordLightShafts()   the library's
//   a rendering scope with depthAttachment():
//     recordTerrain()             linear radiance, as if there were no atmosphere
//     recordAerialPerspective()   the library's: the atmosphere in front of the terrain
//     recordSky()                 the library's: the pixels that are left
//     recordBalloons()            each with its own aerial perspective, blended
#pragma once

#include <alpenglow/io/scene_file.h>
#include <alpenglow/view.h>

#include <optional>
#include <vector>

#include "common/gpu.h"
#include "landscape_pipelines.h"
#include "terrain_mesh.h"

namespace alpenglow::samples {

struct LandscapeDesc {
  Context* context = nullptr;
  const Tables* tables = nullptr;  ///< On the same context as those that will be drawn with.
  VkExtent2D size = {};            ///< Of the picture, in pixels.
  VkFormat colorFormat = VK_FORMAT_UNDEFINED;
  Solver solver = Solver::Moments;    ///< As the tables that will be drawn with.
  MieStorage mie = MieStorage::Full;  ///< The same.
  LightShaftDesc shafts;              ///< Method and steps; the rest is filled in.
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

  /// Adds this scene's members of ViewDesc: the formats of its depth, and the light shafts.
  void describe(ViewDesc* view) const;
  /// Makes the pipelines, which read the light shafts of this view. Before anything is recorded.
  /// Throws.
  void follow(const View* view);
  /// Adds this scene's members of FrameDesc: depth planes of the camera, scene depth, casters.
  void describe(FrameDesc* frame) const;

  /// Outside rendering scopes, as the next; the other calls draw for the frame given here.
  /// `shafts`: FrameWork::sets[kViewSetLightShafts].
  void recordFrame(VkCommandBuffer commands, const FrameDesc& draw, VkDescriptorSet shafts);
  /// Leaves the depth image in kDepthRead.
  void recordDepth(VkCommandBuffer commands, const FrameDesc& draw) const;
  void recordTerrain(VkCommandBuffer commands, const Tables* tables, const FrameDesc& draw) const;
  void recordBalloons(VkCommandBuffer commands, const Tables* tables, const FrameDesc& draw) const;

  /// Of the scope of recordTerrain and all after it; null without terrain.
  const VkRenderingAttachmentInfo* depthAttachment() const;

 private:
  void uploadTerrain(const io::SceneTerrain& terrain, const io::AlbedoMap* albedo);
  void makeLightShafts();
  void setDepthPlanes(Camera* camera) const;
  void setPicture(VkCommandBuffer commands, const FrameDesc& draw) const;
  void placeTerrain(VkCommandBuffer commands, const FrameDesc& draw) const;
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
  LandscapeDesc desc_;
  VkDescriptorSet lightShaftSet_ = VK_NULL_HANDLE;  ///< Of this frame.
  uint64_t castersVersion_ = 1;
  std::optional<LandscapePipelines> pipelines_;  ///< Made once images and shafts are there.
};

}  // namespace alpenglow::samples
