// The simpler models' tables, as plans that the bake carries out: docs/models.md.
#pragma once

#include "atmosphere/bake/plan.h"

namespace alpenglow::models {

/// Of the solvers after Solver::Standard. T as the standard solver's, then Psi_ms (Hillaire), or
/// single scattering over (r, mu, mu_s) (Schafhitzel). None of them is a table of the public API.
/// `desc` is completed; `finest` is the format of tables that differences are taken of.
bake::SolverPlan modelPlan(const Parameters& parameters, const TableDesc& desc, TableFormat finest);

}  // namespace alpenglow::models
