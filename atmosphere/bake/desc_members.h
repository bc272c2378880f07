// The counts of a description one after the other, for what treats all of them alike.
#pragma once

#include <alpenglow/tables.h>

#include <iterator>

namespace alpenglow::bake {

inline constexpr uint32_t MomentSettings::*kMomentMembers[] = {
    &MomentSettings::depthMu,     &MomentSettings::depthH,    &MomentSettings::nodesR,
    &MomentSettings::nodesMuS,    &MomentSettings::ringsSky,  &MomentSettings::ringsLimb,
    &MomentSettings::ringsGround, &MomentSettings::azimuths,  &MomentSettings::degree,
    &MomentSettings::sourceGamma, &MomentSettings::sourcePsi, &MomentSettings::solverPanels,
    &MomentSettings::viewPanels};
inline constexpr uint32_t TableSizes::*kSizeMembers[] = {
    &TableSizes::transmittanceMu, &TableSizes::transmittanceR, &TableSizes::irradianceMuS,
    &TableSizes::irradianceR,     &TableSizes::scatteringR,    &TableSizes::scatteringMu,
    &TableSizes::scatteringMuS,   &TableSizes::scatteringNu};
// None is forgotten.
static_assert(sizeof(MomentSettings) == std::size(kMomentMembers) * sizeof(uint32_t));
static_assert(sizeof(TableSizes) == std::size(kSizeMembers) * sizeof(uint32_t));

}  // namespace alpenglow::bake
