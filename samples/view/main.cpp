// alpenglow-view: a scene in a window.
#include <alpenglow/version.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "app.h"
#include "common/failure.h"
#include "common/sample_files.h"
#include "common/scene_plan.h"

namespace alpenglow::view {
namespace {

struct Arguments {
  std::string scene, flythrough, config, size;
  AppOptions options;
};

constexpr char kKeys[] =
    "W A S D and the mouse fly, the arrow keys move the sun, F1 shows all keys, Escape quits.";

void addOptions(CLI::App* app, Arguments* arguments) {
  app->set_help_flag("-h,--help", "Print this help");
  app->set_version_flag("--version", ALPENGLOW_VERSION_STRING);
  app->add_option("SCENE", arguments->scene,
                  "A scene file or a sample scene's name; clear_noon if none is given");
  app->add_option("--walk", arguments->flythrough)->group("");  // The former name.
  app->add_option("--flythrough", arguments->flythrough,
                  "Play a flythrough: a file or a sample flythrough's name");
  app->add_option("--size", arguments->size, "WxH: the window's size");
  app->add_option("--config", arguments->config,
                  "Keys and window settings: JSON with comments; instead of the user's view.json");
  app->add_option("--device", arguments->options.device, "The Vulkan device: INDEX or NAME");
  app->add_option("--script", arguments->options.script,
                  "Do the steps in this file: docs/viewer.md lists them");
  app->add_option("--shaders", arguments->options.shaders,
                  "Load shaders from this folder, one like shaders/glsl, as they are edited");
  app->add_flag("--validation", arguments->options.validation,
                "Check all Vulkan calls; a message ends the program with status 1");
  app->footer(kKeys);
}

void parseSize(const std::string& text, Config* config) {
  unsigned width = 0, height = 0;
  char after = 0;
  const bool good = std::sscanf(text.c_str(), "%5ux%5u%c", &width, &height, &after) == 2 &&
                    width >= 64 && height >= 64 && width <= 16384 && height <= 16384;
  if (!good) {
    throw samples::Failure("--size " + text +
                               " was given, but WxH with sides from 64 to 16384, such as 1280x720, "
                               "is expected.",
                           samples::Failure::kUsage);
  }
  config->width = width;
  config->height = height;
}

AppOptions optionsOf(const Arguments& arguments) {
  AppOptions options = arguments.options;
  if (!arguments.flythrough.empty() && !arguments.scene.empty()) {
    throw samples::Failure("The scene '" + arguments.scene + "' and the flythrough '" +
                               arguments.flythrough + "' were given; one of them was expected.",
                           samples::Failure::kUsage);
  }
  const std::string config = arguments.config.empty() ? usualConfig() : arguments.config;
  if (!config.empty()) options.config = readConfig(config);
  if (!arguments.size.empty()) parseSize(arguments.size, &options.config);
  if (!arguments.flythrough.empty()) {
    options.flythrough =
        samples::take(io::readFlythrough(samples::findSample("flythroughs", arguments.flythrough)));
    options.scene = options.flythrough->keys.front().scene;
  } else {
    const std::string scene = arguments.scene.empty() ? "clear_noon" : arguments.scene;
    options.scene = samples::take(io::readScene(samples::findSample("scenes", scene)));
  }
  samples::checkScenery(options.scene);
  return options;
}

int runProgram(int argc, char** argv) {
  CLI::App app("Shows a scene in a window, in which every parameter can be changed.",
               "alpenglow-view");
  Arguments arguments;
  addOptions(&app, &arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    throw samples::Failure(std::string(error.what()) + "; --help lists what there is.",
                           samples::Failure::kUsage);
  }
  App program(optionsOf(arguments));
  const size_t messages = program.run();
  if (messages == 0) return 0;
  throw samples::Failure("The validation layer sent " + std::to_string(messages) + " messages.");
}

}  // namespace
}  // namespace alpenglow::view

int main(int argc, char** argv) {
  try {
    return alpenglow::view::runProgram(argc, argv);
  } catch (const alpenglow::samples::Failure& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return failure.exitStatus();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
