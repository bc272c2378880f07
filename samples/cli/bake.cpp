#include "commands.h"
#include "failure.h"
#include "tables.h"

namespace alpenglow::cli {

void runBake(const BakeArguments& arguments) {
  const io::AtmosphereSource source = take(io::findAtmosphereOrScene(arguments.atmosphere));
  io::TableFile file;
  file.parameters = source.parameters;
  file.desc = describeTables(arguments.tables, source.scene ? &*source.scene : nullptr);
  checkOutputs(arguments.run);
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
