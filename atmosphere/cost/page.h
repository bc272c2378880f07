// The HTML page of a report.
#pragma once

#include <alpenglow/cost.h>

#include <string>
#include <vector>

namespace alpenglow::cost {

/// index.html; links to the files beside it.
std::string pageOf(const Report& report);

/// Where a simpler model or the standard solver is not beaten: a configuration of the moment solver
/// that draws at least as fast is farther from the truth.
struct Exception {
  std::string name, band;
  double error = 0.0, frame_ms = 0.0;  ///< Of the rival.
  double best = 0.0;  ///< Least error of moments in no more time; 0: none is as fast.
};
std::vector<Exception> exceptionsOf(const Report& report);

/// Path of a comparison's picture without its ending, in the report's folder.
std::string pictureStem(const Comparison& comparison);

}  // namespace alpenglow::cost
