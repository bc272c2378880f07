#include "arguments.h"

#include <alpenglow/io/scene_file.h>
#include <alpenglow/io/table_file.h>

#include <algorithm>
#include <functional>

#include "failure.h"
#include "frame_list.h"

namespace alpenglow::cli {
namespace {

using Check = std::function<std::string(const std::string&)>;

bool isWholeNumber(const std::string& text) {
  return !text.empty() && text.size() <= 9 &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

Check oneOf(std::vector<std::string> values) {
  return [values](const std::string& text) {
    if (std::find(values.begin(), values.end(), text) != values.end()) return std::string();
    std::string list;
    for (size_t i = 0; i < values.size(); ++i) {
      if (i > 0) list += i + 1 == values.size() ? " or " : ", ";
      list += "'" + values[i] + "'";
    }
    return "'" + text + "' is unknown, expected " + list;
  };
}

Check sizeBy(bool (*parse)(const std::string&, TableSizes*), const char* shape) {
  return [parse, shape](const std::string& text) {
    TableDesc desc;
    desc.solver = Solver::Standard;
    desc =
        io::resolved(desc, presets(nullptr)->parameters);  // Sizes of Standard follow no parameter.
    if (!parse(text, &desc.sizes)) {
      return "'" + text + "' is not of the form " + shape + " with whole numbers from 2 to " +
             std::to_string(io::kMaxTableSide);
    }
    std::string error = io::checkSizes(desc).error;
    if (!error.empty()) error.pop_back();  // The full stop; more is put around it.
    return error;
  };
}

std::string checkMoments(const std::string& text) {
  TableSizes ignored;
  std::string error = io::parseMomentSettings(text, &ignored).error;
  if (!error.empty()) error.pop_back();
  return error;
}

std::string checkOrders(const std::string& text) {
  const uint32_t orders = isWholeNumber(text) ? parseOrders(text) : 0;
  if (orders >= 1 && orders <= kMaxOrders) return {};
  return "'" + text + "' is not a whole number from 1 to " + std::to_string(kMaxOrders);
}

std::string checkPictureSize(const std::string& text) {
  uint32_t width = 0;
  uint32_t height = 0;
  parsePictureSize(text, &width, &height);
  const auto good = [](uint32_t side) { return side >= 1 && side <= io::kMaxPictureSide; };
  if (good(width) && good(height)) return {};
  return "'" + text + "' is not of the form WxH with whole numbers from 1 to " +
         std::to_string(io::kMaxPictureSide);
}

}  // namespace

uint32_t parseOrders(const std::string& text) { return static_cast<uint32_t>(std::stoul(text)); }

uint64_t parseSamples(const std::string& text) { return std::stoull(text); }

void parsePictureSize(const std::string& text, uint32_t* width, uint32_t* height) {
  const size_t times = std::min(text.find('x'), text.size());
  const std::string sides[2] = {text.substr(0, times),
                                text.substr(std::min(times + 1, text.size()))};
  *width = isWholeNumber(sides[0]) ? static_cast<uint32_t>(std::stoul(sides[0])) : 0;
  *height = isWholeNumber(sides[1]) ? static_cast<uint32_t>(std::stoul(sides[1])) : 0;
}

const char* TableArguments::firstTableOption() const {
  if (solver) return "--solver";
  if (quality) return "--quality";
  if (moments) return "--moments";
  if (sizeTransmittance) return "--size-transmittance";
  if (sizeIrradiance) return "--size-irradiance";
  if (sizeScattering) return "--size-scattering";
  if (format) return "--format";
  if (mie) return "--mie";
  return keepOrders ? "--keep-orders" : nullptr;
}

void TableArguments::checkBelongTo(Solver chosen, const std::string& why) const {
  const std::pair<const char*, const std::optional<std::string>*> ofMoments[] = {
      {"--quality", &quality}, {"--moments", &moments}};
  const std::pair<const char*, const std::optional<std::string>*> ofStandard[] = {
      {"--size-transmittance", &sizeTransmittance},
      {"--size-irradiance", &sizeIrradiance},
      {"--size-scattering", &sizeScattering},
      {"--mie", &mie}};
  const auto check = [&](const auto& options, Solver owner) {
    for (const auto& [name, value] : options) {
      if (chosen == owner || !*value) continue;
      throw Failure(std::string(name) + " " + **value + " belongs to the solver " +
                        io::solverName(owner) + ", but " + why + ".",
                    Failure::kUsage);
    }
  };
  check(ofMoments, Solver::Moments);
  check(ofStandard, Solver::Standard);
}

void addTableOptions(CLI::App* command, const std::string& keepOrdersHelp,
                     TableArguments* arguments) {
  const auto add = [&](const char* name, std::optional<std::string>* target, const char* type,
                       const char* help, Check check) {
    command->add_option(name, *target, help)
        ->type_name(type)
        ->check(std::move(check))
        ->group("Tables");
  };
  add("--solver", &arguments->solver, "standard|moments",
      "How the tables are solved (default moments)", oneOf(io::solverNames()));
  add("--orders", &arguments->orders, "N",
      "Most events of a path, 1 to 1000 (default: all; of standard 5)", checkOrders);
  add("--quality", &arguments->quality, "LEVEL",
      "Of moments: draft, low, medium, high or ultra (default medium)", oneOf(io::qualityNames()));
  add("--moments", &arguments->moments, "KEY=N[,KEY=N...]",
      "Of moments: single settings in place of the level's, such as nodesR=24,degree=16",
      checkMoments);
  add("--size-transmittance", &arguments->sizeTransmittance, "MUxR",
      "Of standard: texels of the transmittance (default 256x64)",
      sizeBy(io::parseTransmittanceSize, "MUxR"));
  add("--size-irradiance", &arguments->sizeIrradiance, "MUSxR",
      "Of standard: texels of the irradiance (default 64x16)",
      sizeBy(io::parseIrradianceSize, "MUSxR"));
  add("--size-scattering", &arguments->sizeScattering, "RxMUxMUSxNU",
      "Of standard: texels of the scattering (default 32x128x32x8)",
      sizeBy(io::parseScatteringSize, "RxMUxMUSxNU"));
  add("--mie", &arguments->mie, "full|packed",
      "Of standard: single Mie scattering in three channels or in one (default full)",
      oneOf({"full", "packed"}));
  add("--format", &arguments->format, "half|float", "Numbers of the tables (default half)",
      oneOf({"half", "float"}));
  command->add_flag("--keep-orders", arguments->keepOrders, keepOrdersHelp)->group("Tables");
}

void addTableFileOption(CLI::App* command, TableArguments* arguments) {
  command->add_option("--tables", arguments->tables, "Load baked tables instead of baking")
      ->type_name("TABLES.exr")
      ->group("Tables");
}

void addRunOptions(CLI::App* command, const std::string& outputHelp, RunArguments* arguments) {
  command->add_option("-o,--output", arguments->output, outputHelp)->required()->type_name("FILE");
  command->add_option("--device", arguments->device, "Vulkan device, by index or part of its name")
      ->type_name("INDEX|NAME");
  command->add_option("--report", arguments->report, "Write what was done and what it cost")
      ->type_name("FILE.json");
}

void addSizeOption(CLI::App* command, std::string* size) {
  command->add_option("--size", *size, "Pixels of the picture (default: the scene's)")
      ->type_name("WxH")
      ->check(checkPictureSize);
}

void addFlythroughOptions(CLI::App* command, RenderArguments* arguments) {
  command->add_option("--walk", arguments->flythrough)->group("");  // The former name.
  command
      ->add_option("--flythrough", arguments->flythrough,
                   "Render a flythrough instead of a scene, a sample flythrough's name or a "
                   "flythrough file: each "
                   "frame a picture in the folder of -o, frame_00000.png onward")
      ->type_name("FLYTHROUGH.json");
  command
      ->add_option("--format-image", arguments->imageFormat,
                   "Of a flythrough's pictures (default png)")
      ->type_name("png|exr")
      ->check(oneOf({"png", "exr"}));
  command
      ->add_option("--frames", arguments->frames,
                   "The frames of a flythrough to render, such as 0,24,48-96 (default: all)")
      ->type_name("LIST")
      ->check(checkFrames);
}

void addLightShaftOptions(CLI::App* command, RenderArguments* arguments) {
  command
      ->add_option("--shafts", arguments->shafts,
                   "Light shafts of a terrain: exact, the sum over all lit segments of a ray; "
                   "paper, one length of shadow a ray; march, samples along it; off; or auto, "
                   "exact where there is terrain and the device can (default: the scene's)")
      ->type_name("METHOD")
      ->check(oneOf({"exact", "paper", "march", "off", "auto"}));
  command
      ->add_option("--shaft-samples", arguments->lightShaftStepCount,
                   "Samples along a ray, of march, 1 to " +
                       std::to_string(io::kMaxLightShaftSteps) + " (default: the scene's)")
      ->type_name("N")
      ->check([](const std::string& text) {
        const uint64_t samples = isWholeNumber(text) ? parseSamples(text) : 0;
        if (samples >= 1 && samples <= io::kMaxLightShaftSteps) return std::string();
        return "'" + text + "' is not a whole number from 1 to " +
               std::to_string(io::kMaxLightShaftSteps);
      });
}

void addMethodOptions(CLI::App* command, ProbeArguments* arguments) {
  command
      ->add_option("--method", arguments->method,
                   "tables: on the device (default); reference: by path tracing in double "
                   "precision, all orders unless --orders is given")
      ->type_name("tables|reference")
      ->check(oneOf({"tables", "reference"}));
  command
      ->add_option("--samples", arguments->samples,
                   "Paths that the reference traces for each query, 1 to 999999999 (default: until "
                   "the standard error is 0.1 % by day, more in twilight)")
      ->type_name("N")
      ->check([](const std::string& text) {
        const bool good = isWholeNumber(text) && parseSamples(text) >= 1;
        return good ? std::string() : "'" + text + "' is not a whole number from 1 to 999999999";
      });
}

}  // namespace alpenglow::cli
