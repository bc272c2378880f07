// What kind of solver a value is, and its name in sentences.
#pragma once

#include <alpenglow/tables.h>

namespace alpenglow {

/// The simpler models.
constexpr bool isModel(Solver solver) { return solver > Solver::Standard; }
/// Those whose views may look into a sky-view LUT.
constexpr bool hasSkyViewLut(Solver solver) {
  return !isModel(solver) || solver == Solver::Hillaire;
}
/// Those whose rays take TableSizes::stepCount points, and how many by default; 0: not of this
/// solver.
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
