// The reference with its tolerance open, for tests of its own convergence.
#pragma once

#include <alpenglow/reference/reference.h>

#include <span>

#include "atmosphere/reference/optical_depth.h"

namespace alpenglow::reference {

/// What referenceSingleScattering() returns to its users.
inline constexpr double kRelativeTolerance = 1e-9;

/// Ok where a probe file may hold this query: finite numbers, no negative altitude, zenith angles
/// from 0 to 180 degrees. Else InvalidArgument with a sentence.
Status checkQuery(const ProbeQuery& query, const DiagnosticSink& sink);
/// OutOfHostMemory with a sentence.
Status outOfMemory(const DiagnosticSink& sink, const char* function);

/// Single scattering for a valid query, each value to about `tolerance` times itself. `shadow`:
/// where along the ray, in metres from the observer, something hides the sun besides the planet:
/// sorted, apart, as shadowIntervals() gives them. The ground under the ray's end is dark if one
/// reaches it.
ReferenceAnswer singleScattering(const physics_f64::Medium& medium, const ProbeQuery& query,
                                 double tolerance, std::span<const RayInterval> shadow = {});

/// alpenglow::bandSunElevation() of a valid query.
double bandSunElevation(const physics_f64::Medium& medium, const ProbeQuery& query);

}  // namespace alpenglow::reference
