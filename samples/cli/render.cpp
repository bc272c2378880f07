#include <alpenglow/io/image_file.h>
#include <alpenglow/io/tone_map.h>

#include "commands.h"
#include "failure.h"
#include "outputs.h"
#include "picture.h"
#include "sample_scenes.h"
#include "tables.h"

namespace alpenglow::cli {
namespace {

// What scene files may ask for and this version doesn't draw yet.
void refuseUndrawn(const io::Scene& scene) {
  if (scene.terrain) {
    throw Failure("The scene has a terrain, '" + scene.terrain->heightMap +
                  "', but this version draws none.");
  }
  if (scene.camera.orthographicHeight_m) {
    throw Failure(
        "The scene's camera is orthographic, but this version draws only perspectives "
        "and fisheyes.");
  }
}

void writePicture(const std::string& path, const io::Scene& scene, const io::LinearImage& image) {
  if (hasEnding(path, ".exr")) {
    check(io::writeExr(path, image));
    return;
  }
  const double exposure = scene.exposure ? *scene.exposure : io::automaticExposure(image);
  check(io::writePng(path, io::toneMapped(image, exposure, scene.toneMap)));
}

}  // namespace

void runRender(const RenderArguments& arguments) {
  const std::string& output = arguments.run.output;
  checkEnding(output, {".exr", ".png"});
  io::Scene scene = take(io::readScene(findScene(arguments.scene)));
  refuseUndrawn(scene);
  if (!arguments.size.empty()) parsePictureSize(arguments.size, &scene.width, &scene.height);
  std::optional<io::AlbedoMap> albedo;
  if (!scene.albedoMap.empty()) albedo = take(io::readAlbedoMap(scene.albedoMap));
  TableRequest request = requestTables(arguments.tables, scene.atmosphere, &scene);
  checkOutputs(arguments.run);

  // Loaded tables need nothing of a bake.
  const CapabilityFlags bake = request.file ? CapabilityFlags{0} : kCapabilityBake;
  Session session(arguments.run.device, bake | kCapabilitySky);
  const PictureTarget target = createPictureTarget(&session, scene.width, scene.height);
  const ReadyTables ready = obtainTables(&session, scene.atmosphere, std::move(request));
  const io::LinearImage image =
      drawScene(&session, scene, albedo ? &*albedo : nullptr, ready, target);
  writePicture(output, scene, image);
  if (!arguments.run.report.empty()) {
    writeText(arguments.run.report, io::formatReport(session.report()));
  }
}

}  // namespace alpenglow::cli
