// Means of many paths, batch by batch: the same numbers however the batches are dealt out.
#pragma once

#include "atmosphere/reference/path_tracer.h"

namespace alpenglow::reference {

/// Paths of a batch: a whole net of the Sobol sequence. Batches are independent of each other, and
/// the standard error comes from the spread of their means.
inline constexpr uint64_t kBatchPaths = 1024;
inline constexpr uint64_t kLeastBatches = 32;

struct Estimate {
  Spectrum value;
  Spectrum error;
};

/// Mean and standard error of the batches' means, for each channel.
Estimate estimateOf(const std::vector<physics_f64::Spectrum>& batches);

/// What is estimated. With `air`: light scattered along a segment of `length` metres in direction
/// `view` by paths of `least` to `most` events. With `surface`: irradiance of the sky on a
/// horizontal surface at `surfacePlace`, by paths of at most `surfaceMost` events.
struct Task {
  bool air = false;
  Observer observer;
  Vector view{0.0, 0.0, 1.0};
  double length = 0.0;
  uint32_t least = 2;
  uint32_t most = kAllOrders;
  bool surface = false;
  Observer surfacePlace;
  uint32_t surfaceMost = kAllOrders;
  /// Light below which an error is not counted relative to the light; per channel.
  Spectrum leastRadiance;
  /// The atmosphere's part that is known already, and what a unit of the surface's irradiance, and
  /// the direct light there, add to the surface's answer: they count in relative errors.
  Spectrum knownAir;
  Spectrum surfaceFactor{{1.0, 1.0, 1.0}};
  Spectrum knownSurface;
};

/// A horizontal place over which the sun has this zenith cosine.
Observer placeUnder(double h, double muS);

/// The orders of a ray's answer after the first: its inscattering, and the ground where it ends.
/// `exact`: the answer of order 1.
Task rayTask(const Medium& medium, const ProbeQuery& query, const ReferenceAnswer& exact,
             uint32_t orders);

/// The sky's light on a horizontal surface.
Task irradianceTask(const Medium& medium, const ProbeQuery& query, uint32_t orders);

struct TaskResult {
  Estimate air;
  Estimate surface;
  uint64_t pathCount = 0;  ///< Paths of the part that took more.
};

/// Options as alpenglow::ReferenceOptions has them; `target` is the error to stop at.
TaskResult run(const PathTracer& tracer, const Task& task, const ReferenceOptions& options,
               double target);

}  // namespace alpenglow::reference
