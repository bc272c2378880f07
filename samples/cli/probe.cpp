#include <alpenglow/io/probe_file.h>

#include <ctime>

#include "commands.h"
#include "failure.h"
#include "outputs.h"
#include "probe_reference.h"
#include "tables.h"

namespace alpenglow::cli {
namespace {

constexpr size_t kQueriesASubmission = 16384;

std::string probeTables(Session* session, const Tables* tables,
                        const std::vector<io::NamedQuery>& queries) {
  std::vector<ProbeQuery> plain;
  for (const io::NamedQuery& named : queries) plain.push_back(named.query);
  std::vector<ProbeAnswer> answers(plain.size());
  for (size_t first = 0; first < plain.size(); first += kQueriesASubmission) {
    const auto count = static_cast<uint32_t>(std::min(kQueriesASubmission, plain.size() - first));
    const headless::HostBuffer buffer =
        session->hostBuffer(count * kProbeAnswerBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    session->run([&](VkCommandBuffer commands) {
      session->check(recordProbe(tables, commands, &plain[first], count, buffer.buffer()));
      return "probe";
    });
    session->nextFrame();
    session->check(answerQueries(tables, &plain[first], count, buffer.data(), &answers[first]));
  }
  return take(io::formatAnswers(queries, answers));
}

void runOnDevice(const ProbeArguments& arguments, const io::AtmosphereSource& source,
                 const std::vector<io::NamedQuery>& queries) {
  TableRequest request =
      requestTables(arguments.tables, source.parameters, source.scene ? &*source.scene : nullptr);
  checkOutputs(arguments.run, {arguments.atmosphere, arguments.queries, arguments.tables.tables});
  Session session(arguments.run.device, kCapabilityBake);
  const ReadyTables ready = obtainTables(&session, source.parameters, std::move(request));
  writeText(arguments.run.output, probeTables(&session, ready.tables.get(), queries));
  if (!arguments.run.report.empty()) {
    writeText(arguments.run.report, io::formatReport(session.report()));
  }
}

void checkReferenceArguments(const TableArguments& tables) {
  if (!tables.tables.empty()) {
    throw Failure("--tables was given, but --method reference uses no tables.", Failure::kUsage);
  }
  if (const char* option = tables.firstTableOption()) {
    throw Failure(std::string(option) + " was given, but --method reference uses no tables.",
                  Failure::kUsage);
  }
}

// The option's, else the scene's, else all.
uint32_t referenceOrders(const TableArguments& tables, const io::Scene* scene) {
  if (tables.orders) return parseOrders(*tables.orders);
  return scene != nullptr && scene->orders ? *scene->orders : 0;
}

void runReference(const ProbeArguments& arguments, const io::AtmosphereSource& source,
                  const std::vector<io::NamedQuery>& queries) {
  checkReferenceArguments(arguments.tables);
  const uint32_t orders =
      referenceOrders(arguments.tables, source.scene ? &*source.scene : nullptr);
  checkOutputs(arguments.run, {arguments.atmosphere, arguments.queries, arguments.tables.tables});
  const std::clock_t start = std::clock();
  const std::vector<ReferenceAnswer> answers = answerByReference(
      source.parameters, queries, orders, arguments.samples ? parseSamples(*arguments.samples) : 0);
  io::ReportPass pass;
  pass.name = "reference";
  pass.cpuSeconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  writeText(arguments.run.output, take(io::formatAnswers(queries, answers)));
  if (!arguments.run.report.empty()) {
    io::Report report;
    report.passes.push_back(pass);
    writeText(arguments.run.report, io::formatReport(report));
  }
}

}  // namespace

void runProbe(const ProbeArguments& arguments) {
  const bool byReference = arguments.method == "reference";
  if (arguments.samples && !byReference) {
    throw Failure("--samples was given, but --method tables traces no paths.", Failure::kUsage);
  }
  const io::AtmosphereSource source = take(io::findAtmosphereOrScene(arguments.atmosphere));
  const std::vector<io::NamedQuery> queries = take(io::readQueries(arguments.queries));
  if (byReference) {
    runReference(arguments, source, queries);
  } else {
    runOnDevice(arguments, source, queries);
  }
}

}  // namespace alpenglow::cli
