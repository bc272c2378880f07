// The reference with its tolerance open, for tests of its own convergence.
#pragma once

#include <alpenglow/reference.h>

#include "atmosphere/model/physics_cpp.h"

namespace alpenglow::reference {

/// What referenceSingleScattering() returns to its users.
inline constexpr double kRelativeTolerance = 1e-9;

/// Single scattering for a valid query, each value to about `tolerance` times itself.
ReferenceAnswer singleScattering(const physics_f64::Medium& medium, const ProbeQuery& query,
                                 double tolerance);

}  // namespace alpenglow::reference
