// The double-precision answers of `probe --method reference`.
#pragma once

#include <alpenglow/io/probe_file.h>

#include <cstdint>
#include <vector>

namespace alpenglow::cli {

/// All answers, with a progress bar, on all cores; `orders` 0 is all of them. `samples` paths for
/// each query; 0: until the error that docs/reference-solution.md states. Throws a Failure.
std::vector<ReferenceAnswer> answerByReference(const Parameters& parameters,
                                               const std::vector<io::NamedQuery>& queries,
                                               uint32_t orders, uint64_t samples);

}  // namespace alpenglow::cli
