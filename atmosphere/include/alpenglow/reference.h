// The double-precision truth, Alpenglow::reference: adaptive quadrature of transmittance and single
// scattering. No Vulkan calls, no threads of its own; every function is thread-safe.
#pragma once

#include <alpenglow/parameters.h>
#include <alpenglow/probe.h>

namespace alpenglow {
inline namespace v1 {

/// An answer with the error that the quadrature estimates for each value.
struct ReferenceAnswer {
  ProbeAnswer value;
  ProbeAnswer standardError;  ///< hitsGround is unused.
};

/// Order 1 (single scattering, and the ground under direct sun), with a relative error of about
/// 1e-8. Irradiance `sky` is 0: it needs at least one event before the surface.
Status referenceSingleScattering(const Parameters& parameters, const ProbeQuery& query,
                                 ReferenceAnswer* out);

}  // namespace v1
}  // namespace alpenglow
