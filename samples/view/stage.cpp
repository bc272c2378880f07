#include "stage.h"

#include <algorithm>
#include <cmath>

#include "common/failure.h"
#include "common/scene_plan.h"

namespace alpenglow::view {
namespace {

ShaftsDesc shaftsOf(io::SceneShafts method, uint32_t shaftSamples, EffectFlags without) {
  ShaftsDesc desc;
  desc.method = method == io::SceneShafts::Paper   ? ShaftMethod::Paper
                : method == io::SceneShafts::March ? ShaftMethod::March
                                                   : ShaftMethod::Exact;
  if (method == io::SceneShafts::March) desc.samples = shaftSamples;
  desc.without = without;
  return desc;
}

}  // namespace

Stage::Stage(const samples::Gpu* gpu, Context* context, VkExtent2D size)
    : gpu_(gpu), context_(context), size_(size) {}

Stage::~Stage() { destroyAll(); }

void Stage::destroyAll() {
  if (view_ != nullptr) destroyView(view_);
  view_ = nullptr;
  landscape_.reset();
  stars_.reset();
  key_.reset();
}

void Stage::load(const io::Scene& scene) {
  std::optional<samples::TerrainMesh> mesh;
  std::optional<io::AlbedoMap> ground, terrain;
  if (scene.terrain) {
    mesh = samples::loadTerrain(scene.atmosphere, *scene.terrain);
    if (!scene.terrain->albedoMap.empty()) {
      terrain = samples::take(io::readAlbedoMap(scene.terrain->albedoMap));
    }
  }
  if (!scene.albedoMap.empty()) ground = samples::take(io::readAlbedoMap(scene.albedoMap));
  gpu_->device().waitIdle();
  destroyAll();
  albedo_ = {};
  if (ground) {
    albedo_ = gpu_->texture(*ground);
    sampler_ = gpu_->sampler(VK_SAMPLER_ADDRESS_MODE_REPEAT);
  }
  mesh_ = std::move(mesh);
  meshRadius_m_ = scene.atmosphere.bottomRadius_m;
  terrainAlbedo_ = std::move(terrain);
  balloons_ = !scene.balloons.empty();
}

Stage::Key Stage::keyOf(const io::Scene& scene, const Air& air) const {
  ViewDesc desc;
  samples::describeView(air.plan, &desc);
  const bool shafts = air.plan.shafts && mesh_ && scene.shafts != io::SceneShafts::Off;
  return {desc.solver,
          desc.mie,
          desc.without,
          air.plan.skySlice,
          air.plan.sceneDepth && mesh_.has_value(),
          air.plan.tables.quality,
          samples::projectionOf(scene.camera),
          shafts ? scene.shafts : io::SceneShafts::Off,
          scene.shaftSamples};
}

void Stage::makeLandscape(const io::Scene& scene, const Key& key, const Air& air) {
  samples::LandscapeDesc desc;
  desc.context = context_;
  desc.tables = air.tables.get();
  desc.size = size_;
  desc.colorFormat = kRadianceFormat;
  desc.solver = key.solver;
  desc.mie = key.mie;
  const ShaftsDesc shafts = shaftsOf(key.shafts, key.shaftSamples, air.plan.viewWithout);
  if (key.shafts != io::SceneShafts::Off) desc.shafts = &shafts;
  landscape_.emplace(gpu_, scene, mesh_ ? &*mesh_ : nullptr,
                     terrainAlbedo_ ? &*terrainAlbedo_ : nullptr, desc);
}

void Stage::makeView(const Key& key, const Air& air) {
  ViewDesc desc;
  desc.colorFormat = kRadianceFormat;
  desc.projection = key.projection;
  samples::describeView(air.plan, &desc);
  if (air.plan.skySlice) desc.skySlice = air.tables.get();
  if (albedo_.image() != VK_NULL_HANDLE) {
    desc.groundAlbedo = {albedo_.view(), sampler_.get(), samples::kSampled.layout,
                         albedo_.extent().width, albedo_.extent().height};
  }
  if (landscape_) landscape_->describe(&desc);
  if (!key.air) desc.sceneDepth = {};
  gpu_->check(createView(context_, desc, &view_));
}

void Stage::prepare(const io::Scene& scene, const Air& air) {
  const Key key = keyOf(scene, air);
  const bool moved = mesh_ && air.parameters.bottomRadius_m != meshRadius_m_;
  if (key_ == key && !moved) {
    if (landscape_) landscape_->follow(air.parameters);
    return;
  }
  gpu_->device().waitIdle();
  if (moved) {
    mesh_ = samples::loadTerrain(air.parameters, *scene.terrain);
    meshRadius_m_ = air.parameters.bottomRadius_m;
    std::fill_n(mappedSun_, 3, 0.0);
  }
  if (key_ == key) {
    landscape_->follow(air.parameters);
    return landscape_->uploadVertices();
  }
  destroyAll();
  if (mesh_ || balloons_) makeLandscape(scene, key, air);
  if (landscape_) landscape_->follow(air.parameters);
  makeView(key, air);
  if (key.solver == Solver::Moments || key.solver == Solver::Standard) {
    stars_.emplace(gpu_, samples::StarsDesc{air.tables.get(), kRadianceFormat,
                                            mesh_ ? samples::kDepthFormat : VK_FORMAT_UNDEFINED,
                                            key.projection, key.solver});
  }
  std::fill_n(mappedSun_, 3, 0.0);
  key_ = key;
}

bool Stage::done(Status status) {
  const bool refused = status == Status::InvalidArgument || status == Status::Unsupported;
  try {
    gpu_->check(status);
  } catch (const std::exception& reason) {
    if (!refused) throw;
    refusal_ = reason.what();
  }
  return status == Status::Ok;
}

void Stage::recordShadows(const Frame& frame, const Air& air, const SkyDraw& draw,
                          PassTimer* timer) {
  const Casters casters = landscape_->casters();
  if (!std::equal(mappedSun_, mappedSun_ + 3, draw.sun.direction)) {
    timer->time(frame, "sun map", [&] {
      done(recordSunMap(landscape_->shafts(), frame.commands, draw.sun.direction,
                        casters));
    });
    std::copy_n(draw.sun.direction, 3, mappedSun_);
  }
  timer->time(frame, "shafts", [&] {
    done(recordShafts(landscape_->shafts(), view_, frame.commands, air.tables.get(),
                      draw, casters));
  });
}

// In the order that landscape.h gives; all of it fits one scope.
void Stage::recordScope(const Frame& frame, const io::Scene& scene, const Air& air,
                        const SkyDraw& draw, PassTimer* timer) {
  const Tables* tables = air.tables.get();
  if (mesh_) {
    timer->time(frame, "terrain", [&] { landscape_->recordTerrain(frame.commands, tables, draw); });
    if (key_->air) {
      timer->time(frame, "air",
                  [&] { done(recordAir(view_, frame.commands, tables, draw)); });
    }
  }
  timer->time(frame, "sky", [&] { done(recordSky(view_, frame.commands, tables, draw)); });
  if (scene.stars && stars_) {
    timer->time(frame, "stars", [&] {
      stars_->record(frame.commands, air.parameters, tables, draw, scene.stars->siderealHours);
    });
  }
  if (balloons_) {
    timer->time(frame, "balloons",
                [&] { landscape_->recordBalloons(frame.commands, tables, draw); });
  }
}

void Stage::record(const Frame& frame, const io::Scene& scene, const Air& air, SkyDraw draw,
                   const Picture& picture, PassTimer* timer) {
  refusal_.clear();
  if (!key_) return;
  // A flight keeps the sun where it is, but for rounding, and a map of its shadows holds that long.
  constexpr double kSame = 1e-7;
  if (std::equal(mappedSun_, mappedSun_ + 3, draw.sun.direction,
                 [](double a, double b) { return std::abs(a - b) < kSame; })) {
    std::copy_n(mappedSun_, 3, draw.sun.direction);
  }
  if (landscape_) draw.depth = landscape_->depthRange(draw.camera);
  if (key_->sliced) {
    timer->time(frame, "sky slice", [&] {
      done(recordSkySlice(view_, frame.commands, air.tables.get(), draw));
    });
  }
  if (landscape_) landscape_->recordFrame(frame.commands, draw);
  if (mesh_) {
    timer->time(frame, "terrain depth", [&] { landscape_->recordDepth(frame.commands, draw); });
    if (landscape_->shafts() != nullptr) recordShadows(frame, air, draw, timer);
  }
  picture.beginDrawing(frame.commands);
  gpu_->render(frame.commands, picture.target(), draw.viewport, VK_ATTACHMENT_LOAD_OP_CLEAR,
               landscape_ ? landscape_->depthAttachment() : nullptr,
               [&] { recordScope(frame, scene, air, draw, timer); });
  picture.endDrawing(frame.commands);
}

}  // namespace alpenglow::view
