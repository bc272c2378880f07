// Which plan a solver has for its tables.
#pragma once

#include "atmosphere/bake/plan.h"

namespace alpenglow {

/// Of `desc`'s solver, whichever it is. `desc` is completed; `finest` is the format of tables that
/// differences are taken of.
bake::SolverPlan solverPlan(const Parameters& parameters, const TableDesc& desc,
                            TableFormat finest);

}  // namespace alpenglow
