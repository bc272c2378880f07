// alpenglow cost: the accuracy-against-time report.
#include <alpenglow/cost.h>

#include "commands.h"
#include "common/sample_files.h"
#include "cost_light_shafts.h"
#include "failure.h"
#include "progress.h"

namespace alpenglow::cli {

void runCost(const CostArguments& arguments) {
  cost::Options options;
  options.quick = arguments.quick;
  options.device = arguments.device;
  options.truthFolder = samples::findData("truth", ALPENGLOW_TRUTH_DIR);
  options.command = "alpenglow cost -o " + arguments.folder + (arguments.quick ? " --quick" : "");
  // A file in the folder's place is reported before minutes of work.
  check(cost::prepareFolder(arguments.folder));
  Progress bar("Measuring");
  options.progress = [&bar](double share, const std::string& what) { bar.update(share, what); };
  options.more = [&] { return measureLightShafts(arguments.device, arguments.quick); };
  const cost::Report report = take(cost::measure(options));
  check(cost::writeReport(report, arguments.folder));
}

}  // namespace alpenglow::cli
