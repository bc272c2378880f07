#include "atmosphere/reference/estimate.h"

#include <vector>

namespace alpenglow::reference {
namespace {

using PhysicsSpectrum = physics_f64::Spectrum;

/// Seeds of the two kinds of paths differ, or a query's two parts would share their errors.
constexpr uint64_t kSurfaceStream = uint64_t{1} << 40;

struct Means {
  PhysicsSpectrum air{0.0};
  PhysicsSpectrum surface{0.0};
};

/// One round: what the threads share.
struct Round {
  const PathTracer* tracer;
  const Task* task;
  PhysicsSpectrum relative;
  uint64_t seed;
  uint64_t firstBatch;
  Means* means;
};

void traceBatch(void* context, uint32_t i) {
  const Round& round = *static_cast<const Round*>(context);
  const Task& task = *round.task;
  const uint64_t batch = round.firstBatch + i;
  Means sums;
  if (task.air) {
    PathSampler sampler(round.seed, batch);
    for (uint64_t k = 0; k < kBatchPaths; ++k) {
      sums.air += round.tracer->skySample(task.observer, task.view, task.length, task.least,
                                          task.most, round.relative, sampler);
    }
  }
  if (task.surface) {
    PathSampler sampler(round.seed, kSurfaceStream + batch);
    for (uint64_t k = 0; k < kBatchPaths; ++k) {
      sums.surface += round.tracer->irradianceSample(task.surfacePlace, task.surfaceMost, sampler);
    }
  }
  const double share = 1.0 / static_cast<double>(kBatchPaths);
  round.means[i] = {sums.air * share, sums.surface * share};
}

/// Mean and standard error of the batches' means, for each channel.
Estimate estimateOf(const std::vector<Means>& batches, PhysicsSpectrum Means::*field) {
  const auto count = static_cast<double>(batches.size());
  Estimate result;
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    const auto channel = static_cast<glm::length_t>(c);
    double sum = 0.0;
    for (const Means& batch : batches) sum += (batch.*field)[channel];
    const double mean = sum / count;
    double squares = 0.0;
    for (const Means& batch : batches) {
      const double difference = (batch.*field)[channel] - mean;
      squares += difference * difference;
    }
    result.value[c] = mean;
    result.error[c] = std::sqrt(squares / (count - 1.0) / count);
  }
  return result;
}

bool isReached(const Task& task, const TaskResult& result, double target) {
  for (uint32_t c = 0; c < kSpectrumSize; ++c) {
    const double least = task.least_radiance[c];
    const double air = std::max(task.knownAir[c] + result.air.value[c], least);
    const double factor = task.surfaceFactor[c];
    const double surface = std::max(task.knownSurface[c] + factor * result.surface.value[c], least);
    if (result.air.error[c] > target * air) return false;
    if (factor * result.surface.error[c] > target * surface) return false;
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
    weights[channel] =
        1.0 / (3.0 * std::max({rough[channel], 0.1 * task.least_radiance[c], 1e-30}));
  }
  return weights;
}

}  // namespace

TaskResult run(const PathTracer& tracer, const Task& task, const ReferenceOptions& options,
               double target) {
  const bool fixed = options.samples > 0;
  const uint64_t wanted = fixed ? options.samples : options.maxSamples;
  const uint64_t most = std::max<uint64_t>((wanted + kBatchPaths - 1) / kBatchPaths, 2);
  TaskResult result;
  if (!task.air && !task.surface) return result;
  std::vector<Means> batches;
  uint64_t next = fixed ? most : std::min(kLeastBatches, most);
  for (;;) {
    const uint64_t first = batches.size();
    batches.resize(next);
    Round round{&tracer,      &task, relativeWeights(tracer, task),
                options.seed, first, &batches[first]};
    const auto count = static_cast<uint32_t>(next - first);
    if (options.parallelFor != nullptr) {
      options.parallelFor(options.parallelUser, count, traceBatch, &round);
    } else {
      for (uint32_t i = 0; i < count; ++i) traceBatch(&round, i);
    }
    result = {estimateOf(batches, &Means::air), estimateOf(batches, &Means::surface),
              next * kBatchPaths};
    if (next >= most || isReached(task, result, target)) return result;
    next = std::min(most, next + std::max(next / 2, uint64_t{1}));
  }
}

}  // namespace alpenglow::reference
