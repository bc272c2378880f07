// The double-precision truth, Alpenglow::reference: adaptive quadrature of transmittance and single
// scattering, and a path tracer for the orders beyond. No Vulkan calls, no threads of its own;
// every function is thread-safe.
#pragma once

#include <alpenglow/parameters.h>
#include <alpenglow/query.h>

namespace alpenglow {
inline namespace v1_0 {

/// An answer with the error of each value: of the path tracer's part the standard error, of what
/// was integrated exactly the quadrature's own estimate.
struct ReferenceAnswer {
  ProbeAnswer value;
  ProbeAnswer standardError;  ///< hitsGround is unused.
  uint64_t pathCount = 0;     ///< Paths traced, of the part (atmosphere or ground) that took more.
};

/// Order 1 (single scattering, and the ground under direct sun), with a relative error of about
/// 1e-8. Irradiance `sky` is 0: it needs at least one event before the surface.
/// InvalidArgument for parameters that validate() refuses and for a query that the probe file
/// would refuse; OutOfHostMemory. Each with a sentence to `sink`, as below.
ALPENGLOW_API Status referenceSingleScattering(const Parameters& parameters,
                                               const ProbeQuery& query, ReferenceAnswer* out,
                                               const DiagnosticSink& sink);

/// Runs body(context, i) for each i below `count`, in any order, on any threads, and returns when
/// all have finished.
using ParallelFor = void (*)(void* user, uint32_t count, void (*body)(void* context, uint32_t i),
                             void* context);

/// How much work the path tracer does. The answers depend on nothing else: neither on the number of
/// threads nor on the order of their work.
struct ReferenceOptions {
  uint32_t orders = 0;     ///< Keep paths of at most this many events; 0: all.
  uint64_t pathCount = 0;  ///< Paths, rounded up to whole batches; 0: until the target.
  /// The standard error to stop at, of the worst channel in the project's measure (relative to
  /// max(value, 0.02 E / pi, 1e-9), E the ground's diffuse irradiance), with the sun above 0
  /// degrees; 0: 1e-3. Three times as much is allowed down to -6 degrees, five times down to -12,
  /// ten times below; see bandSunElevation().
  double targetError = 0.0;
  uint64_t maxPathCount = 0;          ///< Where to stop short of the target; 0: 2^19.
  uint64_t seed = 0;                  ///< Each gives other random numbers.
  ParallelFor parallelFor = nullptr;  ///< Null: all work on the calling thread.
  void* parallelUser = nullptr;
};

/// What the path tracer prepares once for an atmosphere (tables of optical depth). Immutable, so
/// that threads may share it.
class Reference;
ALPENGLOW_API Status createReference(const Parameters& parameters, Reference** out,
                                     const DiagnosticSink& sink);
ALPENGLOW_API void destroyReference(Reference* reference);  ///< Null is fine.

/// The truth for one query: order 1 as referenceSingleScattering has it, the other orders by path
/// tracing. InvalidArgument for a query that the probe file would refuse.
ALPENGLOW_API Status evaluateReference(const Reference* reference, const ProbeQuery& query,
                                       const ReferenceOptions& options, ReferenceAnswer* out,
                                       const DiagnosticSink& sink);

/// The same for a single query, with all preparations.
ALPENGLOW_API Status evaluateReference(const Parameters& parameters, const ProbeQuery& query,
                                       const ReferenceOptions& options, ReferenceAnswer* out,
                                       const DiagnosticSink& sink);

/// The sun's elevation (radians) by which the error of a query is judged: that at the ray's ground
/// hit if it looks from above the top, at its lowest point for rays from there past the planet,
/// else at the observer. 0 for a query that would be refused.
ALPENGLOW_API double bandSunElevation(const Parameters& parameters, const ProbeQuery& query);

}  // namespace v1_0
}  // namespace alpenglow
