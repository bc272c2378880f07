#include "stage.h"

#include <algorithm>
#include <cmath>

#include "common/failure.h"
#include "common/scene_plan.h"

namespace alpenglow::view {
namespace {

LightShaftDesc lightShaftsOf(io::SceneLightShafts method, uint32_t stepCount) {
  LightShaftDesc desc;
  if (method == io::SceneLightShafts::Off) return desc;
  desc.method = method == io::SceneLightShafts::ShadowVolume ? LightShaftMethod::ShadowVolume
                : method == io::SceneLightShafts::RayMarch   ? LightShaftMethod::RayMarch
                                                             : LightShaftMethod::LightVolume;
  if (method == io::SceneLightShafts::RayMarch) desc.stepCount = stepCount;
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

Stage::Key Stage::keyOf(const io::Scene& scene, const BakedAtmosphere& baked) const {
  const ViewDesc& view = baked.plan.view;
  const bool shafts = view.lightShafts.method != LightShaftMethod::Off && mesh_ &&
                      scene.shafts != io::SceneLightShafts::Off;
  return {baked.plan.tables.solver,
          baked.plan.tables.mie,
          view.disabledEffects,
          view.sky == SkyMethod::Lut,
          view.aerialPerspective != AerialPerspective::Off && mesh_.has_value(),
          baked.plan.tables.quality,
          samples::projectionOf(scene.camera),
          shafts ? scene.shafts : io::SceneLightShafts::Off,
          scene.lightShaftStepCount};
}

void Stage::makeLandscape(const io::Scene& scene, const Key& key, const BakedAtmosphere& baked) {
  samples::LandscapeDesc desc;
  desc.context = context_;
  desc.tables = baked.tables.get();
  desc.size = size_;
  desc.colorFormat = kRadianceFormat;
  desc.solver = key.solver;
  desc.mie = key.mie;
  desc.shafts = lightShaftsOf(key.shafts, key.lightShaftStepCount);
  landscape_.emplace(gpu_, scene, mesh_ ? &*mesh_ : nullptr,
                     terrainAlbedo_ ? &*terrainAlbedo_ : nullptr, desc);
}

void Stage::makeView(const Key& key, const BakedAtmosphere& baked) {
  ViewDesc desc = baked.plan.view;
  desc.colorFormat = kRadianceFormat;
  desc.projection = key.projection;
  if (albedo_.image() != VK_NULL_HANDLE) {
    desc.groundAlbedo = {albedo_.view(), samples::kSampled.layout, albedo_.extent(),
                         sampler_.get()};
  }
  desc.lightShafts.method = LightShaftMethod::Off;
  if (!key.baked) desc.aerialPerspective = AerialPerspective::Off;
  if (landscape_) landscape_->describe(&desc);
  gpu_->check(createView(context_, baked.tables.get(), desc, &view_));
  if (landscape_) landscape_->follow(view_);
}

void Stage::prepare(const io::Scene& scene, const BakedAtmosphere& baked) {
  const Key key = keyOf(scene, baked);
  const bool moved = mesh_ && baked.parameters.bottomRadius_m != meshRadius_m_;
  if (key_ == key && !moved) {
    if (landscape_) landscape_->follow(baked.parameters);
    return;
  }
  gpu_->device().waitIdle();
  if (moved) {
    mesh_ = samples::loadTerrain(baked.parameters, *scene.terrain);
    meshRadius_m_ = baked.parameters.bottomRadius_m;
  }
  if (key_ == key) {
    landscape_->follow(baked.parameters);
    return landscape_->uploadVertices();
  }
  destroyAll();
  if (mesh_ || balloons_) makeLandscape(scene, key, baked);
  if (landscape_) landscape_->follow(baked.parameters);
  makeView(key, baked);
  if (key.solver == Solver::Moments || key.solver == Solver::Standard) {
    stars_.emplace(gpu_, samples::StarsDesc{baked.tables.get(), kRadianceFormat,
                                            mesh_ ? samples::kDepthFormat : VK_FORMAT_UNDEFINED,
                                            key.projection, key.solver});
  }
  key_ = key;
}

bool Stage::done(Status status) {
  if (status == Status::NotReady) return false;  // beginFrame has said why.
  const bool refused = status == Status::InvalidArgument || status == Status::Unsupported;
  try {
    gpu_->check(status);
  } catch (const std::exception& reason) {
    if (!refused) throw;
    refusal_ = reason.what();
  }
  return status == Status::Ok;
}

void Stage::recordShadows(const Frame& frame, PassTimer* timer) {
  if ((work_.record & kRecordShadowMap) != 0) {
    timer->time(frame, "shadow map", [&] { done(recordShadowMap(view_, frame.commands)); });
  }
  timer->time(frame, "light shafts", [&] { done(recordLightShafts(view_, frame.commands)); });
}

// In the order that landscape.h gives; all of it fits one scope.
void Stage::recordScope(const Frame& frame, const io::Scene& scene, const BakedAtmosphere& baked,
                        const FrameDesc& draw, PassTimer* timer) {
  const Tables* tables = baked.tables.get();
  if (mesh_) {
    timer->time(frame, "terrain", [&] { landscape_->recordTerrain(frame.commands, tables, draw); });
    if (key_->baked) {
      timer->time(frame, "aerial perspective",
                  [&] { done(recordAerialPerspective(view_, frame.commands)); });
    }
  }
  timer->time(frame, "sky", [&] { done(recordSky(view_, frame.commands)); });
  if (scene.stars && stars_) {
    timer->time(frame, "stars", [&] {
      stars_->record(frame.commands, baked.parameters, tables, draw, scene.stars->siderealHours);
    });
  }
  if (balloons_) {
    timer->time(frame, "balloons",
                [&] { landscape_->recordBalloons(frame.commands, tables, draw); });
  }
}

void Stage::record(const Frame& frame, const io::Scene& scene, const BakedAtmosphere& baked,
                   FrameDesc draw, const Picture& picture, PassTimer* timer) {
  refusal_.clear();
  if (!key_) return;
  draw.tables = baked.tables.get();
  if (landscape_) landscape_->describe(&draw);
  done(beginFrame(view_, draw, &work_));
  if ((work_.record & kRecordLuts) != 0)
    timer->time(frame, "sky-view LUT", [&] { done(recordLuts(view_, frame.commands)); });
  if (landscape_) landscape_->recordFrame(frame.commands, draw, work_.sets[kViewSetLightShafts]);
  if (mesh_) {
    timer->time(frame, "terrain depth", [&] { landscape_->recordDepth(frame.commands, draw); });
    if ((work_.record & kRecordLightShafts) != 0) recordShadows(frame, timer);
  }
  picture.beginDrawing(frame.commands);
  gpu_->render(frame.commands, picture.target(), draw.cameras[0].viewport,
               VK_ATTACHMENT_LOAD_OP_CLEAR, landscape_ ? landscape_->depthAttachment() : nullptr,
               [&] { recordScope(frame, scene, baked, draw, timer); });
  picture.endDrawing(frame.commands);
}

}  // namespace alpenglow::view
