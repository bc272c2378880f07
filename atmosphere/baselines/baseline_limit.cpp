// Where the simpler models are undefined or leave something out.
#include <alpenglow/tables.h>

namespace alpenglow {
inline namespace v1_0 {

const char* modelLimit(Solver solver) {
  switch (solver) {
    case Solver::HoffmanPreetham:
      return "The model is undefined for the sun below the horizon, for cameras above the ground "
             "and for space: it answers for the sun at the horizon and air as at the ground.";
    case Solver::ONeil:
      return "The model has one event of scattering, and no light of the sky on surfaces.";
    case Solver::Schafhitzel:
      return "The model has one event of scattering, no light of the sky on surfaces, and no "
             "azimuth in its table: the planet's shadow can't show.";
    case Solver::Hillaire:
      return "The model takes light of two events and more as isotropic, with a factor for the "
             "whole of the atmosphere that ignores the planet's shadow.";
    default:
      return "";
  }
}

}  // namespace v1_0
}  // namespace alpenglow
