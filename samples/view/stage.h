// Draws a scene: sky, ground, terrain, light shafts, stars and balloons, through one view.
#pragma once

#include <alpenglow/io/scene_file.h>

#include <memory>
#include <optional>

#include "baker.h"
#include "pass_timer.h"
#include "picture.h"
#include "stars/stars.h"
#include "terrain/landscape.h"

namespace alpenglow::view {

class Stage {
 public:
  /// `size`: the most pixels that are drawn. All outlive it.
  Stage(const samples::Gpu* gpu, Context* context, VkExtent2D size);
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  ~Stage();

  /// Reads the files that a scene names. Throws; then nothing has changed.
  void load(const io::Scene& scene);

  /// Makes the pipelines for these tables, unless there are: they follow solver, effects, quality
  /// and shaft method, and no parameter. Waits for the device where it must. Throws.
  void prepare(const io::Scene& scene, const BakedAtmosphere& baked);
  /// Recreates all pipelines at the next prepare(): shaders have changed.
  void forget() { key_.reset(); }

  /// Draws into the picture's target. Outside rendering scopes. What the library refuses is left
  /// out of the picture; refusal() says why.
  void record(const Frame& frame, const io::Scene& scene, const BakedAtmosphere& baked,
              FrameDesc draw, const Picture& picture, PassTimer* timer);
  const std::string& refusal() const { return refusal_; }

  bool hasTerrain() const { return mesh_.has_value(); }

 private:
  /// What pipelines depend on.
  struct Key {
    Solver solver;
    MieStorage mie;
    EffectFlags disabledEffects;
    bool fromLut, baked;
    Quality quality;
    Projection projection;
    io::SceneLightShafts shafts;
    uint32_t lightShaftStepCount;
    bool operator==(const Key&) const = default;
  };
  Key keyOf(const io::Scene& scene, const BakedAtmosphere& baked) const;
  void makeLandscape(const io::Scene& scene, const Key& key, const BakedAtmosphere& baked);
  void makeView(const Key& key, const BakedAtmosphere& baked);
  void recordShadows(const Frame& frame, PassTimer* timer);
  void recordScope(const Frame& frame, const io::Scene& scene, const BakedAtmosphere& baked,
                   const FrameDesc& draw, PassTimer* timer);
  /// Whether the library did it.
  bool done(Status status);
  void destroyAll();

  const samples::Gpu* gpu_;
  Context* context_;
  VkExtent2D size_;
  std::optional<samples::TerrainMesh> mesh_;
  double meshRadius_m_ = 0.0;
  std::optional<io::AlbedoMap> terrainAlbedo_;
  bool balloons_ = false;
  headless::Image albedo_;
  samples::Owned<VkSampler> sampler_;
  std::optional<Key> key_;
  std::optional<samples::Landscape> landscape_;
  std::optional<samples::Stars> stars_;
  View* view_ = nullptr;
  FrameWork work_;  ///< Of the last beginFrame.
  std::string refusal_;
};

}  // namespace alpenglow::view
