// Kinds of solvers, and their names in sentences.
#pragma once

#include <alpenglow/tables.h>

namespace alpenglow {

/// Whether a solver is a simpler model.
constexpr bool isModel(Solver solver) { return solver > Solver::Standard; }
/// Whether views of a solver may have a sky-view LUT.
constexpr bool hasSkyViewLut(Solver solver) {
  return !isModel(solver) || solver == Solver::Hillaire;
}
/// Default of TableSizes::stepCount, the points on a ray; 0: the solver doesn't use it.
constexpr uint32_t defaultStepCount(Solver solver) {
  return solver == Solver::ONeil ? 10 : solver == Solver::Hillaire ? 32 : 0;
}
inline constexpr uint32_t kSolverCount = 6;
/// "Moments"; "?" past the end.
constexpr const char* solverEnumerator(Solver solver) {
  constexpr const char* kNames[kSolverCount] = {"Moments", "Standard",    "HoffmanPreetham",
                                                "ONeil",   "Schafhitzel", "Hillaire"};
  const auto index = static_cast<uint32_t>(solver);
  return index < kSolverCount ? kNames[index] : "?";
}

}  // namespace alpenglow
