#include <alpenglow/io/probe_file.h>
#include <alpenglow/reference.h>

#include <atomic>
#include <ctime>
#include <mutex>
#include <thread>

#include "commands.h"
#include "failure.h"
#include "outputs.h"
#include "progress.h"
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
      session->check(recordProbe(session->context(), tables, commands, session->device().frame(),
                                 &plain[first], count, buffer.buffer()));
      return "probe";
    });
    session->check(readProbe(tables, &plain[first], count, buffer.data(), &answers[first]));
  }
  return take(io::formatAnswers(queries, answers));
}

void runOnDevice(const ProbeArguments& arguments, const io::AtmosphereSource& source,
                 const std::vector<io::NamedQuery>& queries) {
  TableRequest request =
      requestTables(arguments.tables, source.parameters, source.scene ? &*source.scene : nullptr);
  checkOutputs(arguments.run);
  Session session(arguments.run.device, kCapabilityBake);
  const ReadyTables ready = obtainTables(&session, source.parameters, std::move(request));
  writeText(arguments.run.output, probeTables(&session, ready.tables.get(), queries));
  if (!arguments.run.report.empty()) {
    writeText(arguments.run.report, io::formatReport(session.report()));
  }
}

void checkReferenceArguments(const TableArguments& tables, const io::Scene* scene) {
  if (!tables.tables.empty()) {
    throw Failure("--tables was given, but --method reference uses no tables.", Failure::kUsage);
  }
  if (const char* option = tables.firstTableOption()) {
    throw Failure(std::string(option) + " was given, but --method reference uses no tables.",
                  Failure::kUsage);
  }
  const bool asked = tables.orders || (scene != nullptr && scene->orders);
  const uint32_t orders = tables.orders                       ? parseOrders(*tables.orders)
                          : scene != nullptr && scene->orders ? *scene->orders
                                                              : 0;
  if (orders == 1) return;
  throw Failure("--method reference was asked for " +
                    (asked ? std::to_string(orders) + " orders" : std::string("all orders")) +
                    ", but this version's reference answers --orders 1 only.",
                Failure::kUsage);
}

// The reference has no threads of its own, so the queries are dealt out here.
std::vector<ReferenceAnswer> answerAll(const Parameters& parameters,
                                       const std::vector<io::NamedQuery>& queries) {
  std::vector<ReferenceAnswer> answers(queries.size());
  std::atomic<size_t> next = 0;
  std::atomic<size_t> failed = queries.size();
  Progress bar("Integrating");
  const auto work = [&](bool first) {
    for (size_t i = next++; i < queries.size(); i = next++) {
      if (referenceSingleScattering(parameters, queries[i].query, &answers[i]) != Status::Ok) {
        failed = i;
      }
      if (first) bar.update(static_cast<double>(i) / static_cast<double>(queries.size()), "");
    }
  };
  const size_t threads =
      std::min<size_t>(std::max(1u, std::thread::hardware_concurrency()), queries.size());
  std::vector<std::thread> others;
  for (size_t i = 1; i < threads; ++i) others.emplace_back(work, false);
  work(true);
  for (std::thread& thread : others) thread.join();
  if (failed < queries.size()) {
    throw Failure("The reference can't answer query '" + queries[failed].id + "'.");
  }
  return answers;
}

void runReference(const ProbeArguments& arguments, const io::AtmosphereSource& source,
                  const std::vector<io::NamedQuery>& queries) {
  checkReferenceArguments(arguments.tables, source.scene ? &*source.scene : nullptr);
  checkOutputs(arguments.run);
  const std::clock_t start = std::clock();
  const std::vector<ReferenceAnswer> answers = answerAll(source.parameters, queries);
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
  const io::AtmosphereSource source = take(io::findAtmosphereOrScene(arguments.atmosphere));
  const std::vector<io::NamedQuery> queries = take(io::readQueries(arguments.queries));
  if (arguments.method == "reference") {
    runReference(arguments, source, queries);
  } else {
    runOnDevice(arguments, source, queries);
  }
}

}  // namespace alpenglow::cli
