#include <alpenglow/io/image_file.h>
#include <alpenglow/io/tone_map.h>

#include "commands.h"
#include "common/sample_files.h"
#include "common/scene_plan.h"
#include "failure.h"
#include "outputs.h"
#include "picture.h"
#include "tables.h"

namespace alpenglow::cli {

void writePicture(const std::string& path, const io::Scene& scene, const io::LinearImage& image) {
  if (hasEnding(path, ".exr")) {
    check(io::writeExr(path, image));
    return;
  }
  const double exposure = scene.exposure ? *scene.exposure : io::automaticExposure(image);
  check(io::writePng(path, io::toneMapped(image, exposure, scene.toneMap)));
}

namespace {

// Choices that the options and the scene leave open are planned; a table file is used as it is.
Plan planPicture(const RenderArguments& arguments, io::Scene scene, const LightShaftChoice& shafts,
                 TableRequest* request) {
  scene.shafts = shafts.method;  // Options override the scene.
  if (request->file) {
    PlanRequest asked = samples::requestOf(scene);
    for (uint32_t i = 0; i < kEffectCount; ++i) {
      const auto effect = static_cast<Effect>(i);
      if ((kTableEffects & effectBit(effect)) == 0) continue;
      asked.effects[i] = hasEffect(request->desc.disabledEffects, effect) ? Force::On : Force::Off;
    }
    asked.tables = request->desc;
    return samples::planRequest(scene, asked);
  }
  const TableDesc base = describeBase(arguments.tables, scene);
  const Plan plan = samples::planScene(scene, base);
  request->desc = plan.tables;
  return plan;
}

void checkWhatIsRendered(const RenderArguments& arguments) {
  const bool flythroughs = !arguments.flythrough.empty();
  if (flythroughs && !arguments.scene.empty()) {
    throw Failure("The scene '" + arguments.scene + "' and the flythrough '" +
                      arguments.flythrough + "' were given; one of them was expected.",
                  Failure::kUsage);
  }
  if (!flythroughs && arguments.scene.empty()) {
    throw Failure("Neither SCENE nor --flythrough was given; one of them was expected.",
                  Failure::kUsage);
  }
  for (const auto& [name, value] : {std::pair("--format-image", &arguments.imageFormat),
                                    std::pair("--frames", &arguments.frames)}) {
    if (flythroughs || !*value) continue;
    throw Failure(std::string(name) + " " + **value +
                      " belongs to a flythrough, but --flythrough wasn't given.",
                  Failure::kUsage);
  }
}

}  // namespace

void runRender(const RenderArguments& arguments) {
  checkWhatIsRendered(arguments);
  if (!arguments.flythrough.empty()) return runFlythrough(arguments);
  const std::string& output = arguments.run.output;
  checkEnding(output, {".exr", ".png"});
  const std::string file = samples::findSample("scenes", arguments.scene);
  io::Scene scene = take(io::readScene(file));
  samples::checkScenery(scene);
  if (!arguments.size.empty()) parsePictureSize(arguments.size, &scene.width, &scene.height);
  std::optional<io::AlbedoMap> albedo;
  if (!scene.albedoMap.empty()) albedo = take(io::readAlbedoMap(scene.albedoMap));
  TableRequest request = requestTables(arguments.tables, scene.atmosphere, &scene);
  LightShaftChoice shafts = chooseLightShafts(arguments, scene, request.desc.solver);
  const Plan plan = planPicture(arguments, scene, shafts, &request);
  if (plan.view.lightShafts.method == LightShaftMethod::Off)
    shafts.method = io::SceneLightShafts::Off;
  const bool disc = plan.choices[static_cast<uint32_t>(Effect::SunDisc)].on;
  if (!disc) scene.sun.discRadius = 0.0;
  const SceneryFiles files = readScenery(scene);
  std::vector<std::string> inputs = inputsOf(scene);
  inputs.insert(inputs.end(), {file, arguments.tables.tables});
  checkOutputs(arguments.run, inputs);

  // Loaded tables need nothing of a bake.
  const CapabilityFlags bake = request.file ? CapabilityFlags{0} : kCapabilityBake;
  Session session(arguments.run.device,
                  bake | (plan.capabilities & (kCapabilitySky | kCapabilityAerialPerspective)) |
                      shafts.requirements(),
                  shafts.wishes());
  const PictureTarget target = createPictureTarget(&session, scene.width, scene.height);
  const ReadyTables ready = obtainTables(&session, scene.atmosphere, std::move(request));
  std::optional<Scenery> scenery;
  if (scene.terrain || !scene.balloons.empty()) {
    scenery.emplace(&session, scene, files, ready, describeLightShafts(shafts, session), plan);
  }
  Painter painter(&session, albedo ? &*albedo : nullptr, ready, plan,
                  scenery ? &*scenery : nullptr);
  writePicture(output, scene, painter.draw(scene, ready.tables.get(), target));
  if (!arguments.run.report.empty()) {
    writeText(arguments.run.report, io::formatReport(session.report()));
  }
}

}  // namespace alpenglow::cli
