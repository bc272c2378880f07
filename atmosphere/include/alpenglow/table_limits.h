// Bounds of TableSizes, and what follows from them: for hosts that read tables back.
#pragma once

#include <cstdint>

namespace alpenglow {
inline namespace v1_0 {

/// Greatest TableSizes::degree.
inline constexpr uint32_t kMaxDegree = 47;
/// Greatest TableSizes::stepCount.
inline constexpr uint32_t kMaxStepCount = 1024;
/// Texels across a layer of the table of moments: the nodes, and two between any two of them.
constexpr uint32_t fieldTexels(uint32_t nodes) { return 3 * (nodes - 1) + 1; }

}  // namespace v1_0
}  // namespace alpenglow
