// The truth sets of tests/data/truth.
#pragma once

#include "atmosphere/cost/truth.h"

namespace alpenglow::truth {

inline std::vector<std::string> truthNames() { return truthNames(ALPENGLOW_TRUTH_FOLDER); }
/// Never fails for truthNames() in a healthy checkout.
inline io::Result<TruthSet> loadTruth(const std::string& name) {
  return loadTruth(ALPENGLOW_TRUTH_FOLDER, name);
}

}  // namespace alpenglow::truth
