// Whether two scenes are the same, field by field and bit by bit.
#pragma once

#include <alpenglow/io/scene_file.h>

#include <cstdint>
#include <string>

namespace alpenglow::test {

/// Empty, or the first field that differs with both values. Angles may be `angleSteps` doubles
/// apart.
std::string sceneDifference(const io::Scene& a, const io::Scene& b, uint64_t angleSteps = 0);

}  // namespace alpenglow::test
