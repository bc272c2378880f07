// Converts a context's description to the engine's, and the engine's counters to the host's.
#pragma once

#include <alpenglow/context.h>

#include "engine/device.h"

namespace alpenglow {
inline namespace v1_0 {

engine::FeatureSet featureSet(const Requirements& requirements);
/// Makes the context's device, or reports why not: `needed` is what the context's capabilities
/// need.
Status createDevice(const ContextDesc& desc, const Requirements& needed, engine::Device** out);
ResourceReport resourceReportOf(const engine::Counters& counters);

}  // namespace v1_0
}  // namespace alpenglow
