// render --walk: a picture for each frame of a walk.
#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/file.h>
#include <alpenglow/io/walk_file.h>

#include <cstdio>
#include <filesystem>

#include "commands.h"
#include "common/sample_files.h"
#include "common/scene_plan.h"
#include "failure.h"
#include "frame_list.h"
#include "progress.h"
#include "walk_frames.h"

namespace alpenglow::cli {
namespace {

namespace fs = std::filesystem;

// What the walk shows at its keys.
std::vector<io::Scene> keyScenes(const io::Walk& walk) {
  std::vector<io::Scene> scenes;
  for (const io::WalkKey& key : walk.keys) scenes.push_back(io::sceneAt(walk, key.time_s));
  return scenes;
}

// Refuses what any key has, before there is a device: tables that can't be made for its air, or are
// another's. Returns the first key's.
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
    throw Failure("The output '" + folder + "' is no folder; a walk needs one for its frames.");
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

CapabilityFlags needsOf(const io::Scene& scene, const TableRequest& request,
                        const ShaftChoice& shafts) {
  const CapabilityFlags bake = request.file ? CapabilityFlags{0} : kCapabilityBake;
  const CapabilityFlags air = scene.terrain ? CapabilityFlags{kCapabilityAir} : CapabilityFlags{0};
  return bake | kCapabilitySky | air | shafts.needs();
}

}  // namespace

void runWalk(const RenderArguments& arguments) {
  io::Walk walk = take(io::readWalk(samples::findSample("walks", arguments.walk)));
  io::Scene& unmoved = walk.keys.front().scene;
  if (!arguments.size.empty()) parsePictureSize(arguments.size, &unmoved.width, &unmoved.height);
  const uint32_t count = io::frameCount(walk);
  const std::vector<uint32_t> frames =
      parseFrames(arguments.frames.value_or("0-" + std::to_string(count - 1)), count);
  const std::vector<io::Scene> scenes = keyScenes(walk);
  for (const io::Scene& scene : scenes) samples::checkScenery(scene);
  std::optional<io::AlbedoMap> albedo;
  if (!unmoved.albedoMap.empty()) albedo = take(io::readAlbedoMap(unmoved.albedoMap));
  TableRequest request = requestAll(arguments.tables, scenes);
  const ShaftChoice shafts = chooseShafts(arguments, unmoved, request.desc.solver);
  const SceneryFiles files = readScenery(unmoved);
  const std::string format = arguments.imageFormat.value_or("png");
  prepareFolder(arguments.run, frameName(arguments.run.output, frames.front(), format));

  Session session(arguments.run.device, needsOf(unmoved, request, shafts), shafts.wishes());
  WalkFrames pictures({&session, &arguments.tables, albedo ? &*albedo : nullptr, &files,
                       describeShafts(shafts, session)},
                      scenes.front(), std::move(request));
  Progress bar("Rendering");
  for (size_t i = 0; i < frames.size(); ++i) {
    const double time_s = io::timeOfFrame(walk, frames[i]);
    bar.update(static_cast<double>(i) / static_cast<double>(frames.size()),
               "frame " + std::to_string(frames[i]) + " of " + std::to_string(count) + "  " +
                   io::keyAt(walk, time_s).caption);
    const io::Scene scene = io::sceneAt(walk, time_s);
    writePicture(frameName(arguments.run.output, frames[i], format), scene, pictures.draw(scene));
  }
  if (!arguments.run.report.empty()) {
    writeText(arguments.run.report, io::formatReport(session.report()));
  }
}

}  // namespace alpenglow::cli
