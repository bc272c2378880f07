#include "atmosphere/api/solver_plan.h"

#include "atmosphere/baselines/baseline_graph.h"
#include "atmosphere/parameters/solvers.h"

namespace alpenglow {

tables::BakeGraph solverPlan(const Parameters& parameters, const TableDesc& desc,
                             TableFormat finest) {
  if (isModel(desc.solver)) return baselines::baselineGraph(parameters, desc, finest);
  return desc.solver == Solver::Moments ? tables::momentGraph(parameters, desc)
                                        : tables::standardGraph(parameters, desc, finest);
}

}  // namespace alpenglow
