// Bake graphs of the simpler models' tables: docs/baselines.md.
#pragma once

#include "atmosphere/tables/bake_graph.h"

namespace alpenglow::baselines {

/// Of the solvers after Solver::Standard. T as the standard solver's, then Psi_ms (Hillaire), or
/// single scattering over (r, mu, mu_s) (Schafhitzel). None of them is a table of the public API.
/// `desc` is completed; `finest` is the format of tables that differences are taken of.
tables::BakeGraph baselineGraph(const Parameters& parameters, const TableDesc& desc,
                                TableFormat finest);

}  // namespace alpenglow::baselines
