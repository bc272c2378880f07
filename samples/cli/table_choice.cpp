// Which tables the options and the scene ask for, and whether a table file is of that kind.
#include <alpenglow/io/atmosphere_file.h>

#include "failure.h"
#include "tables.h"

namespace alpenglow::cli {
namespace {

struct ChosenSolver {
  Solver solver;
  std::string why;  ///< A clause, for TableArguments::checkBelongTo.
};

// The option's, else the scene's, else the table file's, else the default.
ChosenSolver chooseSolver(const TableArguments& arguments, const io::Scene* scene,
                          const TableDesc* file) {
  if (arguments.solver) {
    return {*io::findSolver(*arguments.solver), "--solver " + *arguments.solver + " was given"};
  }
  if (scene != nullptr && scene->solver) {
    return {*scene->solver, "the scene's solver is " + io::solverName(*scene->solver)};
  }
  if (file != nullptr) {
    return {file->solver, "the table file '" + arguments.tables + "' is of the solver " +
                              io::solverName(file->solver)};
  }
  return {Solver::Moments, "the solver is moments unless --solver standard is given"};
}

// A simpler model's tables have no choices but the scene's own, and no file.
TableDesc describeModel(const TableArguments& arguments, const io::Scene& scene) {
  const std::string model = "the scene's model is " + io::modelName(scene.model);
  const char* given = arguments.orders ? "--orders" : arguments.firstTableOption();
  if (given != nullptr) {
    throw Failure(std::string(given) + " was given, but " + model + ", which has no such choice.",
                  Failure::kUsage);
  }
  if (!arguments.tables.empty()) {
    throw Failure("--tables was given, but " + model + ", whose tables are in no file.",
                  Failure::kUsage);
  }
  TableDesc desc;
  desc.solver = *io::solverOf(scene.model);
  desc.sizes.stepCount = scene.modelStepCount.value_or(0);
  return desc;
}

bool hasModel(const io::Scene* scene) { return scene != nullptr && io::solverOf(scene->model); }

// What options and scene say; the rest is left open.
TableDesc describeGiven(const TableArguments& arguments, const io::Scene* scene,
                        const ChosenSolver& chosen) {
  arguments.checkBelongTo(chosen.solver, chosen.why);
  TableDesc desc;
  desc.solver = chosen.solver;
  if (scene != nullptr) desc.orders = scene->orders.value_or(0);
  if (arguments.orders) desc.orders = parseOrders(*arguments.orders);
  if (arguments.format) {
    desc.format = *arguments.format == "half" ? TableFormat::Half : TableFormat::Float;
  }
  desc.keepOrders = arguments.keepOrders;
  if (chosen.solver == Solver::Moments) {
    if (scene != nullptr) desc.quality = scene->quality.value_or(Quality::Default);
    if (arguments.quality) desc.quality = *io::findQuality(*arguments.quality);
    if (arguments.moments) check(io::parseMomentSettings(*arguments.moments, &desc.sizes));
  }
  if (arguments.mie) {
    desc.mie = *arguments.mie == "full" ? MieStorage::Full : MieStorage::Packed;
  }
  if (arguments.sizeTransmittance) {
    io::parseTransmittanceSize(*arguments.sizeTransmittance, &desc.sizes);
  }
  if (arguments.sizeIrradiance) io::parseIrradianceSize(*arguments.sizeIrradiance, &desc.sizes);
  if (arguments.sizeScattering) io::parseScatteringSize(*arguments.sizeScattering, &desc.sizes);
  return desc;
}

TableDesc describe(const TableArguments& arguments, const Parameters& parameters,
                   const io::Scene* scene, const ChosenSolver& chosen) {
  const TableDesc desc = io::resolved(describeGiven(arguments, scene, chosen), parameters);
  check(io::checkSizes(desc));
  return desc;
}

// Compares what was asked for with what a file holds, choice by choice.
class Comparison {
 public:
  explicit Comparison(const std::string& path) : path_(path) {}

  void operator()(const std::string& name, const std::string& asked, const std::string& holds) {
    if (asked == holds) return;
    throw Failure(name + " " + asked + " was asked for, but the table file '" + path_ + "' holds " +
                  holds + ".");
  }

  /// An option, else the scene's field, if one of them was given.
  void either(const std::optional<std::string>& option, bool inScene, const std::string& name,
              const std::string& asked, const std::string& holds) {
    if (option) return (*this)("--" + name, asked, holds);
    if (inScene) (*this)("\"" + name + "\":", asked, holds);
  }

 private:
  const std::string& path_;
};

std::string ordersText(uint32_t orders) { return orders == 0 ? "all" : std::to_string(orders); }
std::string formatText(TableFormat format) {
  return format == TableFormat::Half ? "half" : "float";
}
std::string mieText(MieStorage mie) { return mie == MieStorage::Full ? "full" : "packed"; }

void compareMoments(const TableArguments& arguments, const io::Scene* scene,
                    const TableDesc& wanted, const TableDesc& file, Comparison* compare) {
  compare->either(arguments.quality, scene != nullptr && scene->quality, "quality",
                  io::qualityName(wanted.quality), io::qualityName(file.quality));
  if (!arguments.moments) return;
  TableSizes changed = file.sizes;
  check(io::parseMomentSettings(*arguments.moments, &changed));
  const std::string holds = io::momentSettingsText(file.sizes);
  if (io::momentSettingsText(changed) != holds) (*compare)("--moments", *arguments.moments, holds);
}

void compareStandard(const TableArguments& arguments, const TableDesc& wanted,
                     const TableDesc& file, Comparison* compare) {
  if (arguments.sizeTransmittance) {
    (*compare)("--size-transmittance", io::transmittanceSizeText(wanted.sizes),
               io::transmittanceSizeText(file.sizes));
  }
  if (arguments.sizeIrradiance) {
    (*compare)("--size-irradiance", io::irradianceSizeText(wanted.sizes),
               io::irradianceSizeText(file.sizes));
  }
  if (arguments.sizeScattering) {
    (*compare)("--size-scattering", io::scatteringSizeText(wanted.sizes),
               io::scatteringSizeText(file.sizes));
  }
  if (arguments.mie) (*compare)("--mie", mieText(wanted.mie), mieText(file.mie));
}

// Throws when an option, or the scene, asks for other tables than the file's.
void checkAgainst(const TableArguments& arguments, const io::Scene* scene,
                  const io::TableFile& file) {
  Comparison compare(arguments.tables);
  const ChosenSolver chosen = chooseSolver(arguments, scene, &file.desc);
  compare.either(arguments.solver, scene != nullptr && scene->solver, "solver",
                 io::solverName(chosen.solver), io::solverName(file.desc.solver));
  const TableDesc wanted = describe(arguments, file.parameters, scene, chosen);
  compare.either(arguments.orders, scene != nullptr && scene->orders, "orders",
                 ordersText(wanted.orders), ordersText(file.desc.orders));
  if (wanted.solver == Solver::Moments) {
    compareMoments(arguments, scene, wanted, file.desc, &compare);
  } else {
    compareStandard(arguments, wanted, file.desc, &compare);
  }
  if (arguments.format) {
    compare("--format", formatText(wanted.format), formatText(file.desc.format));
  }
}

io::TableFile loadTableFile(const TableArguments& arguments, const Parameters& parameters,
                            const io::Scene* scene) {
  io::TableFile file = take(io::readTableFile(arguments.tables));
  const std::string difference =
      io::firstDifference(file.parameters, parameters, " in it", " in the atmosphere asked for");
  if (!difference.empty()) {
    throw Failure("The table file '" + arguments.tables +
                  "' was baked for another atmosphere: " + difference + ".");
  }
  checkAgainst(arguments, scene, file);
  return file;
}

}  // namespace

TableDesc describeBase(const TableArguments& arguments, const io::Scene& scene) {
  if (hasModel(&scene)) return describeModel(arguments, scene);
  return describeGiven(arguments, &scene, chooseSolver(arguments, &scene, nullptr));
}

TableDesc describeTables(const TableArguments& arguments, const Parameters& parameters,
                         const io::Scene* scene) {
  if (hasModel(scene)) return describeModel(arguments, *scene);
  return describe(arguments, parameters, scene, chooseSolver(arguments, scene, nullptr));
}

TableRequest requestTables(const TableArguments& arguments, const Parameters& parameters,
                           const io::Scene* scene) {
  TableRequest request;
  if (arguments.tables.empty() || hasModel(scene)) {
    request.desc = describeTables(arguments, parameters, scene);
    return request;
  }
  request.file = loadTableFile(arguments, parameters, scene);
  request.desc = request.file->desc;
  return request;
}

}  // namespace alpenglow::cli
