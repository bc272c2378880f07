// render --flythrough: a picture for each frame of a flythrough.
#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/file.h>
#include <alpenglow/io/flythrough_file.h>

#include <cstdio>
#include <filesystem>

#include "commands.h"
#include "common/sample_files.h"
#include "common/scene_plan.h"
#include "failure.h"
#include "flythrough_frames.h"
#include "frame_list.h"
#include "progress.h"

namespace alpenglow::cli {
namespace {

namespace fs = std::filesystem;

// What the flythrough shows at its keys.
std::vector<io::Scene> keyScenes(const io::Flythrough& flythrough) {
  std::vector<io::Scene> scenes;
  for (const io::FlythroughKey& key : flythrough.keys)
    scenes.push_back(io::sceneAt(flythrough, key.time_s));
  return scenes;
}

// Checks all keys before there is a device: refuses tables that can't be made for a key's
// atmosphere, or that are for another one. Returns the tables of the first key.
TableRequest requestAll(const TableArguments& arguments, const std::vector<io::Scene>& scenes) {
  TableRequest first = requestTables(arguments, scenes.front().atmosphere, &scenes.front());
  for (size_t i = 1; i < scenes.size(); ++i) {
    const Parameters& air = scenes[i].atmosphere;
    if (io::firstDifference(scenes[i - 1].atmosphere, air).empty()) continue;
    requestTables(arguments, air, &scenes[i]);
  }
  return first;
}

std::string frameName(const std::string& folder, uint32_t frame, const std::string& format) {
  char name[32];
  std::snprintf(name, sizeof name, "frame_%05u.", static_cast<unsigned>(frame));
  return (fs::path(folder) / (name + format)).string();
}

// Makes the folder if there is none, and takes it back when something in it can't be written.
void prepareFolder(const RunArguments& arguments, const std::string& firstFrame) {
  const std::string& folder = arguments.output;
  std::error_code code;
  const bool there = fs::exists(folder, code);
  if (there && !fs::is_directory(folder, code)) {
    throw Failure("The output '" + folder +
                  "' is no folder; a flythrough needs one for its frames.");
  }
  if (!there && !fs::create_directory(folder, code)) {
    throw Failure("Cannot make the folder '" + folder + "': " + code.message() + ".");
  }
  try {
    check(io::checkOutput(firstFrame));
    if (!arguments.report.empty()) check(io::checkOutput(arguments.report));
  } catch (...) {
    if (!there) fs::remove(folder, code);  // Only if it is empty.
    throw;
  }
}

CapabilityFlags requestOf(const io::Scene& scene, const TableRequest& request,
                          const LightShaftChoice& shafts) {
  const CapabilityFlags bake = request.file ? CapabilityFlags{0} : kCapabilityBake;
  const CapabilityFlags air =
      scene.terrain ? CapabilityFlags{kCapabilityAerialPerspective} : CapabilityFlags{0};
  return bake | kCapabilitySky | air | shafts.requirements();
}

}  // namespace

void runFlythrough(const RenderArguments& arguments) {
  io::Flythrough flythrough =
      take(io::readFlythrough(samples::findSample("flythroughs", arguments.flythrough)));
  io::Scene& unmoved = flythrough.keys.front().scene;
  if (!arguments.size.empty()) parsePictureSize(arguments.size, &unmoved.width, &unmoved.height);
  const uint32_t count = io::frameCount(flythrough);
  const std::vector<uint32_t> frames =
      parseFrames(arguments.frames.value_or("0-" + std::to_string(count - 1)), count);
  const std::vector<io::Scene> scenes = keyScenes(flythrough);
  for (const io::Scene& scene : scenes) samples::checkScenery(scene);
  std::optional<io::AlbedoMap> albedo;
  if (!unmoved.albedoMap.empty()) albedo = take(io::readAlbedoMap(unmoved.albedoMap));
  TableRequest request = requestAll(arguments.tables, scenes);
  const LightShaftChoice shafts = chooseLightShafts(arguments, unmoved, request.desc.solver);
  const SceneryFiles files = readScenery(unmoved);
  const std::string format = arguments.imageFormat.value_or("png");
  prepareFolder(arguments.run, frameName(arguments.run.output, frames.front(), format));

  Session session(arguments.run.device, requestOf(unmoved, request, shafts), shafts.wishes());
  FlythroughFrames pictures({&session, &arguments.tables, albedo ? &*albedo : nullptr, &files,
                             describeLightShafts(shafts, session)},
                            scenes.front(), std::move(request));
  Progress bar("Rendering");
  for (size_t i = 0; i < frames.size(); ++i) {
    const double time_s = io::timeOfFrame(flythrough, frames[i]);
    bar.update(static_cast<double>(i) / static_cast<double>(frames.size()),
               "frame " + std::to_string(frames[i]) + " of " + std::to_string(count) + "  " +
                   io::keyAt(flythrough, time_s).caption);
    const io::Scene scene = io::sceneAt(flythrough, time_s);
    writePicture(frameName(arguments.run.output, frames[i], format), scene, pictures.draw(scene));
  }
  if (!arguments.run.report.empty()) {
    writeText(arguments.run.report, io::formatReport(session.report()));
  }
}

}  // namespace alpenglow::cli
