// Which plan a solver has for its tables.
#pragma once

#include "atmosphere/tables/bake_graph.h"

namespace alpenglow {

/// Of `desc`'s solver, whichever it is. `desc` is completed; `finest` is the format of tables that
/// differences are taken of.
tables::BakeGraph solverPlan(const Parameters& parameters, const TableDesc& desc,
                             TableFormat finest);

}  // namespace alpenglow
