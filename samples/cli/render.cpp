#include <alpenglow/io/image_file.h>
#include <alpenglow/io/tone_map.h>

#include "commands.h"
#include "failure.h"
#include "outputs.h"
#include "picture.h"
#include "sample_files.h"
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

void checkWhatIsRendered(const RenderArguments& arguments) {
  const bool walks = !arguments.walk.empty();
  if (walks && !arguments.scene.empty()) {
    throw Failure("The scene '" + arguments.scene + "' and the walk '" + arguments.walk +
                      "' were given; one of them was expected.",
                  Failure::kUsage);
  }
  if (!walks && arguments.scene.empty()) {
    throw Failure("Neither SCENE nor --walk was given; one of them was expected.", Failure::kUsage);
  }
  for (const auto& [name, value] : {std::pair("--format-image", &arguments.imageFormat),
                                    std::pair("--frames", &arguments.frames)}) {
    if (walks || !*value) continue;
    throw Failure(
        std::string(name) + " " + **value + " belongs to a walk, but --walk wasn't given.",
        Failure::kUsage);
  }
}

}  // namespace

void runRender(const RenderArguments& arguments) {
  checkWhatIsRendered(arguments);
  if (!arguments.walk.empty()) return runWalk(arguments);
  const std::string& output = arguments.run.output;
  checkEnding(output, {".exr", ".png"});
  io::Scene scene = take(io::readScene(findSample("scenes", arguments.scene)));
  checkScenery(scene);
  if (!arguments.size.empty()) parsePictureSize(arguments.size, &scene.width, &scene.height);
  std::optional<io::AlbedoMap> albedo;
  if (!scene.albedoMap.empty()) albedo = take(io::readAlbedoMap(scene.albedoMap));
  TableRequest request = requestTables(arguments.tables, scene.atmosphere, &scene);
  const ShaftChoice shafts = chooseShafts(arguments, scene, request.desc.solver);
  const SceneryFiles files = readScenery(scene);
  checkOutputs(arguments.run);

  // Loaded tables need nothing of a bake.
  const CapabilityFlags bake = request.file ? CapabilityFlags{0} : kCapabilityBake;
  Session session(arguments.run.device,
                  bake | kCapabilitySky | sceneryNeeds(scene) | shafts.needs(), shafts.wishes());
  const PictureTarget target = createPictureTarget(&session, scene.width, scene.height);
  std::optional<Scenery> scenery;
  if (scene.terrain || !scene.balloons.empty()) {
    scenery.emplace(&session, scene, files, request.desc, describeShafts(shafts, session));
  }
  const ReadyTables ready = obtainTables(&session, scene.atmosphere, std::move(request));
  Painter painter(&session, scene, albedo ? &*albedo : nullptr, ready,
                  scenery ? &*scenery : nullptr);
  writePicture(output, scene, painter.draw(scene, ready.tables.get(), target));
  if (!arguments.run.report.empty()) {
    writeText(arguments.run.report, io::formatReport(session.report()));
  }
}

}  // namespace alpenglow::cli
