// The public path tracer: order 1 from single_scattering.h, the others from estimate.h.
#include <alpenglow/reference/reference.h>

#include <new>
#include <numbers>

#include "atmosphere/parameters/sentence.h"
#include "atmosphere/reference/estimate.h"
#include "atmosphere/reference/single_scattering.h"

namespace alpenglow {
inline namespace v1_0 {

class Reference {
 public:
  explicit Reference(const Parameters& parameters) : tracer(makeMediumF64(parameters)) {}
  const reference::PathTracer tracer;
};

}  // namespace v1_0

namespace reference {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

/// How much more error the target allows for under a low sun.
double allowance(double sunElevation) {
  const double degrees = sunElevation / kDegree + 1e-9;
  return degrees >= 0.0 ? 1.0 : degrees >= -6.0 ? 3.0 : degrees >= -12.0 ? 5.0 : 10.0;
}

/// The radiance below which errors count absolutely: 2 % of the ground's, were it white.
Spectrum leastRadiance(const PathTracer& tracer, double sunElevation) {
  Task task;
  task.surface = true;
  task.surfacePlace = placeUnder(0.0, std::sin(sunElevation));
  ReferenceOptions options;
  options.pathCount = 2 * kBatchPaths;
  const Estimate light = run(tracer, task, options, 1.0).surface;
  Spectrum least;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    least[c] = std::max(0.02 * light.value[c] / std::numbers::pi, 1e-9);
  }
  return least;
}

void addTo(Spectrum* value, Spectrum* error, const Estimate& part, const Spectrum& factor) {
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    (*value)[c] += factor[c] * part.value[c];
    (*error)[c] = std::hypot((*error)[c], factor[c] * part.error[c]);
  }
}

ReferenceAnswer evaluate(const PathTracer& tracer, const ProbeQuery& query,
                         const ReferenceOptions& options) {
  const Medium& medium = tracer.medium();
  const uint32_t orders = options.orders == 0 ? kAllOrders : options.orders;
  ReferenceAnswer answer = singleScattering(medium, query, kRelativeTolerance);
  Task task = query.kind == QueryKind::Irradiance ? irradianceTask(medium, query, orders)
                                                  : rayTask(medium, query, answer, orders);
  if (!task.air && !task.surface) return answer;
  double target = 0.0;
  if (options.pathCount == 0) {
    const double elevation = bandSunElevation(medium, query);
    target = options.targetError * allowance(elevation);
    task.leastRadiance = leastRadiance(tracer, elevation);
  }
  const TaskResult result = run(tracer, task, options, target);
  answer.pathCount = result.pathCount;
  constexpr Spectrum kOne = {{1.0, 1.0, 1.0}};
  if (task.air)
    addTo(&answer.value.skyRadiance, &answer.standardError.skyRadiance, result.air, kOne);
  if (task.surface && query.kind == QueryKind::Irradiance) {
    addTo(&answer.value.sky, &answer.standardError.sky, result.surface, kOne);
  } else if (task.surface) {
    addTo(&answer.value.groundRadiance, &answer.standardError.groundRadiance, result.surface,
          task.surfaceFactor);
  }
  return answer;
}

constexpr const char* kName = "evaluateReference";

Status checkCall(const ProbeQuery& query, const ReferenceOptions& options,
                 const ReferenceAnswer* out, const DiagnosticSink& sink) {
  if (out == nullptr) return parameters::reportNull(sink, kName, "the answer");
  if (Status status = checkQuery(query, sink); status != Status::Ok) return status;
  if (options.targetError >= 0.0) return Status::Ok;
  parameters::Sentence why;
  why << "ReferenceOptions::targetError is " << options.targetError
      << ", but it must be above 0, or 0 for the default.";
  return parameters::report(sink, Status::InvalidArgument, why);
}

ReferenceOptions completed(const ReferenceOptions& options) {
  ReferenceOptions full = options;
  if (full.targetError == 0.0) full.targetError = 1e-3;
  if (full.maxPathCount == 0) full.maxPathCount = uint64_t{1} << 19;
  return full;
}

}  // namespace
}  // namespace reference

inline namespace v1_0 {

Status createReference(const Parameters& parameters, Reference** out, const DiagnosticSink& sink) {
  if (out == nullptr) return parameters::reportNull(sink, "createReference", "the reference");
  if (Status status = validate(parameters, sink); status != Status::Ok) return status;
  try {
    *out = new Reference(parameters);
  } catch (const std::bad_alloc&) {
    return reference::outOfMemory(sink, "createReference");
  }
  return Status::Ok;
}

void destroyReference(Reference* reference) { delete reference; }

Status evaluateReference(const Reference* reference, const ProbeQuery& query,
                         const ReferenceOptions& options, ReferenceAnswer* out,
                         const DiagnosticSink& sink) {
  if (reference == nullptr) return parameters::reportNull(sink, reference::kName, "the reference");
  if (Status status = reference::checkCall(query, options, out, sink); status != Status::Ok)
    return status;
  try {
    *out = reference::evaluate(reference->tracer, query, reference::completed(options));
  } catch (const std::bad_alloc&) {
    return reference::outOfMemory(sink, reference::kName);
  }
  return Status::Ok;
}

Status evaluateReference(const Parameters& parameters, const ProbeQuery& query,
                         const ReferenceOptions& options, ReferenceAnswer* out,
                         const DiagnosticSink& sink) {
  Reference* prepared = nullptr;
  Status status = reference::checkCall(query, options, out, sink);  // Preparations take long.
  if (status == Status::Ok) status = createReference(parameters, &prepared, sink);
  if (status == Status::Ok) status = evaluateReference(prepared, query, options, out, sink);
  destroyReference(prepared);
  return status;
}

}  // namespace v1_0
}  // namespace alpenglow
