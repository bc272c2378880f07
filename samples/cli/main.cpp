// alpenglow: bakes atmospheres, renders scenes and answers point queries. See docs/.
#include <alpenglow/io/file.h>
#include <alpenglow/version.h>
#include <signal.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <sstream>

#include "commands.h"
#include "common/gpu.h"
#include "failure.h"

namespace alpenglow::cli {
namespace {

struct Arguments {
  std::string preset;
  BakeArguments bake;
  RenderArguments render;
  ExplainArguments explain;
  ProbeArguments probe;
  CostArguments cost;
};

constexpr const char* kAtmosphereHelp = "A preset's name, an atmosphere file or a scene file";
constexpr const char* kKeepOrdersHelp =
    "Keep the tables of each scattering order while baking, as bake does; none is written";

void addPresets(CLI::App* app, Arguments* arguments) {
  CLI::App* command = app->add_subcommand("presets", "List the atmospheres, or print one as JSON");
  command->add_option("NAME", arguments->preset, "The atmosphere to print");
  command->callback([arguments] { runPresets(arguments->preset); });
}

void addBake(CLI::App* app, Arguments* arguments) {
  BakeArguments* bake = &arguments->bake;
  CLI::App* command = app->add_subcommand("bake", "Bake the tables of an atmosphere and save them");
  command->add_option("ATMOSPHERE", bake->atmosphere, kAtmosphereHelp)->required();
  addRunOptions(command, "The table file to write, an EXR", &bake->run);
  addTableOptions(command, "Save the tables of each scattering order too", &bake->tables);
  command->callback([bake] { runBake(*bake); });
}

void addRender(CLI::App* app, Arguments* arguments) {
  RenderArguments* render = &arguments->render;
  CLI::App* command =
      app->add_subcommand("render", "Render a scene to a picture, or a flythrough to many");
  command->add_option("SCENE", render->scene, "A sample scene's name or a scene file");
  addRunOptions(command,
                "The picture to write: .exr for linear radiance, .png for an exposed and tone "
                "mapped picture; of a flythrough, the folder",
                &render->run);
  addFlythroughOptions(command, render);
  addSizeOption(command, &render->size);
  addLightShaftOptions(command, render);
  addTableOptions(command, kKeepOrdersHelp, &render->tables);
  addTableFileOption(command, &render->tables);
  command->callback([render] { runRender(*render); });
}

void addExplain(CLI::App* app, Arguments* arguments) {
  ExplainArguments* explain = &arguments->explain;
  CLI::App* command = app->add_subcommand(
      "explain", "Print the plan of a scene: effects, sizes and methods, and the reasons");
  command->add_option("SCENE", explain->scene, "A sample scene's name or a scene file")->required();
  command->add_flag("--json", explain->json, "For programs");
  command->callback([explain] { runExplain(*explain); });
}

void addProbe(CLI::App* app, Arguments* arguments) {
  ProbeArguments* probe = &arguments->probe;
  CLI::App* command = app->add_subcommand("probe", "Answer point queries");
  command->add_option("ATMOSPHERE", probe->atmosphere, kAtmosphereHelp)->required();
  command->add_option("--queries", probe->queries, "The queries to answer")
      ->required()
      ->type_name("Q.json");
  addRunOptions(command, "The answers to write, as JSON", &probe->run);
  addMethodOptions(command, probe);
  addTableOptions(command, kKeepOrdersHelp, &probe->tables);
  addTableFileOption(command, &probe->tables);
  command->callback([probe] { runProbe(*probe); });
}

#ifdef ALPENGLOW_WITH_COST
void addCost(CLI::App* app, Arguments* arguments) {
  CostArguments* cost = &arguments->cost;
  CLI::App* command = app->add_subcommand(
      "cost", "Measure what accuracy costs in time, on this device, as a page with charts");
  command->add_option("-o,--output", cost->folder, "The folder to write to, which is made")
      ->required()
      ->type_name("DIR");
  command->add_flag("--quick", cost->quick, "Fewer settings and fewer runs");
  command->add_option("--device", cost->device, "A Vulkan device, by index or part of its name")
      ->type_name("INDEX|NAME");
  command->callback([cost] { runCost(*cost); });
}
#endif

// CLI11's message as one sentence.
std::string usageSentence(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && (text.back() == '.' || text.back() == ' ')) text.pop_back();
  return text + "; --help lists what there is.";
}

void checkCommand(const CLI::App& app, int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  const bool asksForHelp = first == "-h" || first == "--help" || first == "--version";
  if (asksForHelp) return;
  if (first.rfind("-", 0) == 0) {
    throw Failure(
        "The option '" + first + "' is unknown before a command; --help lists what " + "there is.",
        Failure::kUsage);
  }
  std::string list;
  for (const CLI::App* command : app.get_subcommands(nullptr)) {
    if (command->get_name() == first) return;
    list += (list.empty() ? "" : ", ") + command->get_name();
  }
  throw Failure((argc > 1 ? "The command '" + first + "' is unknown" : "No command was given") +
                    "; the commands are " + list + ".",
                Failure::kUsage);
}

int parseAndRun(int argc, char** argv) {
  CLI::App app("An atmosphere for Vulkan engines: bakes, renders and probes it.", "alpenglow");
  app.set_version_flag("--version", "alpenglow " ALPENGLOW_VERSION_STRING,
                       "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.require_subcommand(0, 1);
  Arguments arguments;
  addPresets(&app, &arguments);
  addBake(&app, &arguments);
  addRender(&app, &arguments);
  addProbe(&app, &arguments);
  addExplain(&app, &arguments);
#ifdef ALPENGLOW_WITH_COST
  addCost(&app, &arguments);
#endif
  checkCommand(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != 0) throw Failure(usageSentence(error.what()), Failure::kUsage);
    std::ostringstream ignored;
    app.exit(error, std::cout, ignored);
  }
  std::cout.flush();
  if (!std::cout) throw Failure("Cannot write to the standard output.");
  return 0;
}

// Names and ids from outside may hold line breaks; a sentence is one line.
void say(std::string sentence) {
  for (char& c : sentence) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7F') c = '?';
  }
  std::fprintf(stderr, "%s\n", sentence.c_str());
}

// Half-written files go; then the signal does what it does by default, so that the shell sees it.
void cleanUpOnSignals() {
  struct sigaction action = {};
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  action.sa_handler = [](int signal) {
    io::removePendingFiles();
    ::raise(signal);
  };
  sigemptyset(&action.sa_mask);
  ::signal(SIGXFSZ, SIG_IGN);  // A file that grows too long is an error of its write.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGXCPU}) {
    struct sigaction before = {};
    // What the caller ignores stays ignored, as nohup wants it.
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      sigaction(signal, &action, nullptr);
  }
}

}  // namespace
}  // namespace alpenglow::cli

int main(int argc, char** argv) {
  alpenglow::cli::cleanUpOnSignals();
  try {
    return alpenglow::cli::parseAndRun(argc, argv);
  } catch (const alpenglow::cli::Failure& failure) {
    alpenglow::cli::say(failure.what());
    return failure.exitStatus();
  } catch (const alpenglow::samples::Error& error) {
    alpenglow::cli::say(error.what());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "There is not enough memory for this.\n");
  } catch (const std::exception& problem) {
    alpenglow::cli::say(std::string("The program failed: ") + problem.what() + ".");
  }
  return alpenglow::cli::Failure::kFailed;
}
