#include <alpenglow/io/file.h>

#include "commands.h"
#include "failure.h"
#include "outputs.h"
#include "tables.h"

namespace alpenglow::cli {

void runBake(const BakeArguments& arguments) {
  checkEnding(arguments.run.output, {".exr"});
  const io::AtmosphereSource source = take(io::findAtmosphereOrScene(arguments.atmosphere));
  if (source.scene && io::solverOf(source.scene->model)) {
    throw Failure("The scene's model is " + io::modelName(source.scene->model) +
                  ", whose tables are saved to no file; render and probe bake them.");
  }
  io::TableFile file;
  file.parameters = source.parameters;
  file.desc =
      describeTables(arguments.tables, source.parameters, source.scene ? &*source.scene : nullptr);
  check(io::checkReplaceable(arguments.run.output));  // A table file is sealed after writing.
  checkOutputs(arguments.run, {arguments.atmosphere});
  Session session(arguments.run.device, kCapabilityBake);
  std::vector<io::TablePart> orders;
  {
    const TablesPointer tables =
        bakeTables(&session, file.parameters, file.desc, file.desc.keepOrders ? &orders : nullptr);
    file.parts = readTables(&session, tables.get(), file.desc);
  }
  for (io::TablePart& part : orders) file.parts.push_back(std::move(part));
  check(io::writeTableFile(arguments.run.output, file));
  if (!arguments.run.report.empty()) {
    writeText(arguments.run.report, io::formatReport(session.report()));
  }
}

}  // namespace alpenglow::cli
