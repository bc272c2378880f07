#include "atmosphere/api/solver_plan.h"

#include "atmosphere/model/solvers.h"
#include "atmosphere/models/model_plan.h"

namespace alpenglow {

bake::SolverPlan solverPlan(const Parameters& parameters, const TableDesc& desc,
                            TableFormat finest) {
  if (isModel(desc.solver)) return models::modelPlan(parameters, desc, finest);
  return desc.solver == Solver::Moments ? bake::momentPlan(parameters, desc)
                                        : bake::standardPlan(parameters, desc, finest);
}

}  // namespace alpenglow
