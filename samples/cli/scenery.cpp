#include "scenery.h"

#include "failure.h"

namespace alpenglow::cli {
namespace {

samples::LandscapeDesc describeLandscape(Session* session, const io::Scene& scene,
                                         const ReadyTables& tables, const LightShaftDesc& shafts) {
  samples::LandscapeDesc desc;
  desc.context = session->context();
  desc.size = {scene.width, scene.height};
  desc.colorFormat = kPictureFormat;
  desc.tables = tables.tables.get();
  desc.solver = tables.desc.solver;
  desc.mie = tables.desc.mie;
  desc.shafts = shafts;
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
                 const ReadyTables& tables, const LightShaftDesc& shafts, const Plan& plan)
    : session_(session),
      gpu_(session->gpu()),
      hasAerialPerspective_(plan.view.aerialPerspective != AerialPerspective::Off),
      landscape_(&gpu_, scene, files.mesh ? &*files.mesh : nullptr,
                 files.albedo ? &*files.albedo : nullptr,
                 describeLandscape(session, scene, tables, shafts)) {}

void Scenery::describe(ViewDesc* view) const { landscape_.describe(view); }

void Scenery::follow(const View* view) { landscape_.follow(view); }

void Scenery::drawLightShafts(View* view) {
  session_->run([&](VkCommandBuffer commands) {
    session_->check(recordShadowMap(view, commands));
    return "shadow map";
  });
  session_->run([&](VkCommandBuffer commands) {
    session_->check(recordLightShafts(view, commands));
    return "light shafts";
  });
}

void Scenery::drawInto(const headless::Image& target, const FrameDesc& draw, const char* pass,
                       bool first, const RecordFn& record) {
  session_->run([&](VkCommandBuffer commands) {
    gpu_.barrier(commands, target, first ? samples::kUndefined : samples::kColorDrawn,
                 samples::kColorDrawn);
    gpu_.render(commands, target, draw.cameras[0].viewport,
                first ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD,
                landscape_.depthAttachment(), [&] { record(commands); });
    return std::string(pass);
  });
}

void Scenery::draw(View* view, const Tables* tables, FrameDesc frame, const headless::Image& target,
                   const RecordFn& stars) {
  landscape_.describe(&frame);
  // An engine records all this into one command buffer; here each pass is run and timed alone,
  // which takes a frame of the library each time.
  FrameWork work;
  session_->run([&](VkCommandBuffer commands) {
    session_->check(beginFrame(view, frame, &work));
    session_->check(recordLuts(view, commands));
    return "sky-view LUT";
  });
  const bool terrain = landscape_.hasTerrain();
  const bool hasLightShafts = (work.record & kRecordLightShafts) != 0;
  if (terrain) {
    session_->run([&](VkCommandBuffer commands) {
      landscape_.recordFrame(commands, frame, work.sets[kViewSetLightShafts]);
      landscape_.recordDepth(commands, frame);
      return "terrain depth";
    });
    if (hasLightShafts) drawLightShafts(view);
    drawInto(target, frame, "terrain", true,
             [&](VkCommandBuffer commands) { landscape_.recordTerrain(commands, tables, frame); });
    if (hasAerialPerspective_)
      drawInto(target, frame, "aerial perspective", false, [&](VkCommandBuffer commands) {
        session_->check(recordAerialPerspective(view, commands));
      });
  }
  drawInto(target, frame, "sky", !terrain,
           [&](VkCommandBuffer commands) { session_->check(recordSky(view, commands)); });
  if (stars) drawInto(target, frame, "stars", false, stars);
  if (!landscape_.hasBalloons()) return;
  if (!terrain) {
    session_->run([&](VkCommandBuffer commands) {
      landscape_.recordFrame(commands, frame, VK_NULL_HANDLE);
      return "balloons";
    });
  }
  drawInto(target, frame, "balloons", false,
           [&](VkCommandBuffer commands) { landscape_.recordBalloons(commands, tables, frame); });
}

}  // namespace alpenglow::cli
