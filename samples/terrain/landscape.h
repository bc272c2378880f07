// A host's scene in Alpenglow's sky: terrain that casts light shafts, and translucent balloons. It
// shows what a host does itself and what it asks the library for; the order of a frame is
//
//   record()             this frame's camera and sun
//   recordDepth()        the terrain's depth alone
//   recordSkySlice(), recordSunMap(), recordShafts()          the library's
//   a rendering scope with the depth attached for reading:
//     recordTerrain()    linear radiance, without air
//     recordAir()        the library's: air in front of the terrain
//     recordSky()        the library's: the pixels that are left
//     recordBalloons()   each with its own air, blended
#pragma once

#include <alpenglow/io/scene_file.h>
#include <alpenglow/shafts.h>

#include <optional>
#include <vector>

#include "gpu.h"
#include "terrain_mesh.h"

namespace alpenglow::samples {

inline constexpr VkFormat kDepthFormat = VK_FORMAT_D32_SFLOAT;

/// What shaders include is chosen by these.
struct LandscapeDesc {
  Context* context = nullptr;
  VkExtent2D size = {};
  VkFormat colorFormat = VK_FORMAT_UNDEFINED;
  Projection projection = Projection::Perspective;
  Solver solver = Solver::Moments;
  MieStorage mie = MieStorage::Full;
  SceneShafts method = SceneShafts::Off;  ///< Auto is taken for Off.
  uint32_t shaftSamples = 0;
};

class Landscape {
 public:
  /// `mesh` may be null: no terrain, then nor depth nor shafts; `albedo` may be null: uniform.
  /// `desc.context` needs kCapabilityShafts for shafts. Throws an Error; sentences of the library
  /// are left to the context's diagnostic callback, and `failed` says so.
  Landscape(const Gpu* gpu, const io::Scene& scene, const TerrainMesh* mesh,
            const io::AlbedoMap* albedo, const LandscapeDesc& desc);
  Landscape(const Landscape&) = delete;
  Landscape& operator=(const Landscape&) = delete;
  ~Landscape();

  bool hasTerrain() const { return indexCount_ > 0; }
  bool hasBalloons() const { return !balloons_.empty(); }
  Shafts* shafts() const { return shafts_; }

  /// Adds what the view must know: the scene's depth and its shafts.
  void describe(ViewDesc* view) const;
  /// Near and far plane for this camera.
  DepthRange depthRange(const Camera& camera) const;
  /// For recordSunMap and recordShafts, while the landscape lives.
  Casters casters();

  /// Outside rendering scopes; the other calls draw what it was given.
  void record(VkCommandBuffer commands, const SkyDraw& draw);
  /// The same; leaves the depth image in kDepthRead.
  void recordDepth(VkCommandBuffer commands, const SkyDraw& draw);
  void recordTerrain(VkCommandBuffer commands, const Tables* tables, const SkyDraw& draw);
  void recordBalloons(VkCommandBuffer commands, const Tables* tables, const SkyDraw& draw);

  /// For the scope of recordTerrain and all after it; null without terrain.
  const VkRenderingAttachmentInfo* depthAttachment() const;

 private:
  void uploadTerrain(const io::SceneTerrain& terrain, const TerrainMesh& mesh,
                     const io::AlbedoMap* albedo);
  void makeShafts(const LandscapeDesc& desc);
  void makeSets(Context* context);
  void makePipelines(const LandscapeDesc& desc);
  void setPicture(VkCommandBuffer commands, const SkyDraw& draw) const;
  void bindSets(VkCommandBuffer commands, const Tables* tables) const;
  void drawTerrain(VkCommandBuffer commands) const;
  void drawCasters(VkCommandBuffer commands, const CasterPass* pass) const;

  const Gpu* gpu_;
  std::vector<io::SceneBalloon> balloons_;
  std::vector<std::array<double, 6>> balloonPlaces_;
};

}  // namespace alpenglow::samples
