#include "scenery.h"

#include "failure.h"

namespace alpenglow::cli {
namespace {

samples::LandscapeDesc describeLandscape(Session* session, const io::Scene& scene,
                                         const ReadyTables& tables,
                                         const std::optional<ShaftsDesc>& shafts) {
  samples::LandscapeDesc desc;
  desc.context = session->context();
  desc.size = {scene.width, scene.height};
  desc.colorFormat = kPictureFormat;
  desc.tables = tables.tables.get();
  desc.solver = tables.desc.solver;
  desc.mie = tables.desc.mie;
  desc.shafts = shafts ? &*shafts : nullptr;
  return desc;
}

}  // namespace

SceneryFiles readScenery(const io::Scene& scene) {
  SceneryFiles files;
  if (!scene.terrain) return files;
  files.mesh = samples::loadTerrain(scene.atmosphere, *scene.terrain);
  if (!scene.terrain->albedoMap.empty()) {
    files.albedo = take(io::readAlbedoMap(scene.terrain->albedoMap));
  }
  return files;
}

Scenery::Scenery(Session* session, const io::Scene& scene, const SceneryFiles& files,
                 const ReadyTables& tables, const std::optional<ShaftsDesc>& shafts, const Plan& plan)
    : session_(session),
      gpu_(session->gpu()),
      hasAir_(plan.sceneDepth),
      landscape_(&gpu_, scene, files.mesh ? &*files.mesh : nullptr,
                 files.albedo ? &*files.albedo : nullptr,
                 describeLandscape(session, scene, tables, shafts)) {}

void Scenery::describe(ViewDesc* view) const {
  landscape_.describe(view);
  if (!hasAir_) view->sceneDepth = {};
}

void Scenery::drawShafts(View* view, const Tables* tables, const SkyDraw& draw) {
  const Casters casters = landscape_.casters();
  session_->run([&](VkCommandBuffer commands) {
    session_->check(recordSunMap(landscape_.shafts(), commands,
                                 draw.sun.direction, casters));
    return "sun map";
  });
  session_->run([&](VkCommandBuffer commands) {
    session_->check(recordShafts(landscape_.shafts(), view, commands,
                                 tables, draw, casters));
    return "shafts";
  });
}

void Scenery::drawInto(const headless::Image& target, const SkyDraw& draw, const char* pass,
                       bool first, const RecordFn& record) {
  session_->run([&](VkCommandBuffer commands) {
    gpu_.barrier(commands, target, first ? samples::kUndefined : samples::kColorDrawn,
                 samples::kColorDrawn);
    gpu_.render(commands, target, draw.viewport,
                first ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD,
                landscape_.depthAttachment(), [&] { record(commands); });
    return std::string(pass);
  });
}

void Scenery::draw(View* view, const Tables* tables, SkyDraw draw, const headless::Image& target,
                   const RecordFn& stars) {
  draw.depth = landscape_.depthRange(draw.camera);
  // An engine records all this into one command buffer; here each pass is run and timed alone.
  session_->run([&](VkCommandBuffer commands) {
    session_->check(recordSkySlice(view, commands, tables, draw));
    return "sky slice";
  });
  const bool terrain = landscape_.hasTerrain();
  if (terrain) {
    session_->run([&](VkCommandBuffer commands) {
      landscape_.recordFrame(commands, draw);
      landscape_.recordDepth(commands, draw);
      return "terrain depth";
    });
    if (landscape_.shafts() != nullptr) drawShafts(view, tables, draw);
    drawInto(target, draw, "terrain", true,
             [&](VkCommandBuffer commands) { landscape_.recordTerrain(commands, tables, draw); });
    if (hasAir_)
      drawInto(target, draw, "air", false, [&](VkCommandBuffer commands) {
        session_->check(recordAir(view, commands, tables, draw));
      });
  }
  drawInto(target, draw, "sky", !terrain, [&](VkCommandBuffer commands) {
    session_->check(recordSky(view, commands, tables, draw));
  });
  if (stars) drawInto(target, draw, "stars", false, stars);
  if (landscape_.hasBalloons()) {
    if (!terrain) {
      session_->run([&](VkCommandBuffer commands) {
        landscape_.recordFrame(commands, draw);
        return "balloons";
      });
    }
    drawInto(target, draw, "balloons", false,
             [&](VkCommandBuffer commands) { landscape_.recordBalloons(commands, tables, draw); });
  }
}

}  // namespace alpenglow::cli
