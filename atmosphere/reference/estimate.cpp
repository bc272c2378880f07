#include "atmosphere/reference/estimate.h"

#include <vector>

namespace alpenglow::reference {
namespace {

using PhysicsSpectrum = physics_f64::Spectrum;

/// Seeds of the two kinds of paths differ, or a query's two parts would share their errors.
constexpr uint64_t kSurfaceStream = uint64_t{1} << 40;

/// One round of batches: what the threads share.
struct Round {
  const PathTracer* tracer;
  const Task* task;
  bool surface;
  PhysicsSpectrum relative;
  uint64_t seed;
  uint64_t firstBatch;
  PhysicsSpectrum* means;
};

void traceBatch(void* context, uint32_t i) {
  const Round& round = *static_cast<const Round*>(context);
  const Task& task = *round.task;
  PathSampler sampler(round.seed, (round.surface ? kSurfaceStream : 0) + round.firstBatch + i);
  PhysicsSpectrum sum(0.0);
  for (uint64_t k = 0; k < kBatchPaths; ++k) {
    sum += round.surface
               ? round.tracer->irradianceSample(task.surfacePlace, task.surfaceMost, sampler)
               : round.tracer->skySample(task.observer, task.view, task.length, task.least,
                                         task.most, round.relative, sampler);
  }
  round.means[i] = sum / static_cast<double>(kBatchPaths);
}

bool isReached(const Task& task, bool surface, const Estimate& estimate, double target) {
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    const double factor = surface ? task.surfaceFactor[c] : 1.0;
    const double known = surface ? task.knownSurface[c] : task.knownAir[c];
    const double light = std::max(known + factor * estimate.value[c], task.leastRadiance[c]);
    if (factor * estimate.error[c] > target * light) return false;
  }
  return true;
}

/// What a unit of each channel counts for, so that all have the same weight in the error.
PhysicsSpectrum relativeWeights(const PathTracer& tracer, const Task& task) {
  PhysicsSpectrum weights(1.0);
  if (!task.air) return weights;
  const PhysicsSpectrum rough = tracer.roughSky(task.observer, task.view, task.length);
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    const auto channel = static_cast<glm::length_t>(c);
    weights[channel] = 1.0 / (3.0 * std::max({rough[channel], 0.1 * task.leastRadiance[c], 1e-30}));
  }
  return weights;
}

/// One of the task's parts, with the number of its batches.
Estimate runPart(const PathTracer& tracer, const Task& task, bool surface,
                 const ReferenceOptions& options, double target, uint64_t* count) {
  const bool fixed = options.pathCount > 0;
  const uint64_t wanted = fixed ? options.pathCount : options.maxPathCount;
  const uint64_t most = std::max<uint64_t>((wanted + kBatchPaths - 1) / kBatchPaths, 2);
  std::vector<PhysicsSpectrum> batches;
  const PhysicsSpectrum relative = relativeWeights(tracer, task);
  *count = fixed ? most : std::min(kLeastBatches, most);
  for (;;) {
    const uint64_t first = batches.size();
    batches.resize(*count);
    Round round{&tracer, &task, surface, relative, options.seed, first, &batches[first]};
    const auto added = static_cast<uint32_t>(*count - first);
    if (options.parallelFor != nullptr) {
      options.parallelFor(options.parallelUser, added, traceBatch, &round);
    } else {
      for (uint32_t i = 0; i < added; ++i) traceBatch(&round, i);
    }
    const Estimate estimate = estimateOf(batches);
    if (*count >= most || isReached(task, surface, estimate, target)) return estimate;
    *count = std::min(most, *count + std::max(*count / 2, uint64_t{1}));
  }
}

}  // namespace

Estimate estimateOf(const std::vector<PhysicsSpectrum>& batches) {
  const auto count = static_cast<double>(batches.size());
  Estimate result;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    const auto channel = static_cast<glm::length_t>(c);
    double sum = 0.0;
    for (const PhysicsSpectrum& batch : batches) sum += batch[channel];
    const double mean = sum / count;
    double squares = 0.0;
    for (const PhysicsSpectrum& batch : batches) {
      squares += (batch[channel] - mean) * (batch[channel] - mean);
    }
    result.value[c] = mean;
    result.error[c] = std::sqrt(squares / (count - 1.0) / count);
  }
  return result;
}

TaskResult run(const PathTracer& tracer, const Task& task, const ReferenceOptions& options,
               double target) {
  TaskResult result;
  uint64_t air = 0, surface = 0;
  if (task.air) result.air = runPart(tracer, task, false, options, target, &air);
  if (task.surface) result.surface = runPart(tracer, task, true, options, target, &surface);
  result.pathCount = std::max(air, surface) * kBatchPaths;
  return result;
}

}  // namespace alpenglow::reference
