#include "probe_reference.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>

#include "failure.h"
#include "progress.h"

namespace alpenglow::cli {
namespace {

// The reference has no threads of its own; these are dealt its work, or whole queries. The calling
// thread works too and says how far it is.
template <typename Work, typename Report>
void dealOut(size_t count, const Work& work, const Report& report) {
  std::atomic<size_t> next = 0;
  const auto some = [&](bool first) {
    for (size_t i = next++; i < count; i = next++) {
      work(i);
      if (first) report(static_cast<double>(i + 1) / static_cast<double>(count));
    }
  };
  const size_t threads = std::min<size_t>(std::max(1u, std::thread::hardware_concurrency()), count);
  std::vector<std::thread> others;
  for (size_t i = 1; i < threads; ++i) others.emplace_back(some, false);
  some(true);
  for (std::thread& thread : others) thread.join();
}

[[noreturn]] void refuse(Status status, const std::string& what) {
  throw Failure("The reference can't answer " + what + " (" + statusName(status) + ").");
}

std::vector<ReferenceAnswer> integrate(const Parameters& parameters,
                                       const std::vector<io::NamedQuery>& queries) {
  std::vector<ReferenceAnswer> answers(queries.size());
  std::atomic<size_t> failed = queries.size();
  Progress bar("Integrating");
  dealOut(
      queries.size(),
      [&](size_t i) {
        if (referenceSingleScattering(parameters, queries[i].query, &answers[i], {}) !=
            Status::Ok) {
          failed = i;
        }
      },
      [&](double done) { bar.update(done, ""); });
  if (failed < queries.size()) {
    refuse(Status::OutOfHostMemory, "query '" + queries[failed].id + "'");
  }
  return answers;
}

// A query's paths are dealt out; the bar stands at the queries that are done.
struct Tracing {
  Progress bar{"Tracing paths"};
  double done = 0.0;
  std::string detail;

  static void run(void* user, uint32_t count, void (*body)(void*, uint32_t), void* context) {
    Tracing* tracing = static_cast<Tracing*>(user);
    dealOut(
        count, [&](size_t i) { body(context, static_cast<uint32_t>(i)); },
        [&](double) { tracing->bar.update(tracing->done, tracing->detail); });
  }
};

}  // namespace

std::vector<ReferenceAnswer> answerByReference(const Parameters& parameters,
                                               const std::vector<io::NamedQuery>& queries,
                                               uint32_t orders, uint64_t samples) {
  if (orders == 1) return integrate(parameters, queries);
  Reference* made = nullptr;
  const Status prepared = createReference(parameters, &made, {});
  if (prepared != Status::Ok) refuse(prepared, "queries of this atmosphere");
  const std::unique_ptr<Reference, void (*)(Reference*)> reference(made, destroyReference);

  Tracing tracing;
  ReferenceOptions options;
  options.orders = orders;
  options.pathCount = samples;
  options.parallelFor = Tracing::run;
  options.parallelUser = &tracing;
  std::vector<ReferenceAnswer> answers(queries.size());
  for (size_t i = 0; i < queries.size(); ++i) {
    tracing.done = static_cast<double>(i) / static_cast<double>(queries.size());
    tracing.detail = queries[i].id;
    tracing.bar.update(tracing.done, tracing.detail);
    const Status status =
        evaluateReference(reference.get(), queries[i].query, options, &answers[i], {});
    if (status != Status::Ok) refuse(status, "query '" + queries[i].id + "'");
  }
  return answers;
}

}  // namespace alpenglow::cli
