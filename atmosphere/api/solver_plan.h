// The bake graph of each solver.
#pragma once

#include "atmosphere/tables/bake_graph.h"

namespace alpenglow {

/// The graph of `desc`'s solver. `desc` is completed; `finest` is the format of tables that
/// differences are taken of.
tables::BakeGraph solverPlan(const Parameters& parameters, const TableDesc& desc,
                             TableFormat finest);

}  // namespace alpenglow
