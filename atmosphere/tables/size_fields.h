// The members of TableSizes, for what treats all of a solver's alike.
#pragma once

#include <alpenglow/tables.h>

#include <iterator>

#include <alpenglow/table_limits.h>

namespace alpenglow::tables {

struct SizeField {
  const char* name;
  uint32_t TableSizes::*member;
  uint32_t least, most;
};

inline constexpr SizeField kMomentFields[] = {{"depthMu", &TableSizes::depthMu, 2, 4096},
                                              {"depthH", &TableSizes::depthH, 2, 4096},
                                              {"nodesR", &TableSizes::nodesR, 2, 256},
                                              {"nodesMuS", &TableSizes::nodesMuS, 2, 512},
                                              {"zenithsSky", &TableSizes::zenithsSky, 2, 256},
                                              {"zenithsLimb", &TableSizes::zenithsLimb, 2, 256},
                                              {"zenithsGround", &TableSizes::zenithsGround, 2, 256},
                                              {"azimuths", &TableSizes::azimuths, 2, 128},
                                              {"degree", &TableSizes::degree, 2, kMaxDegree},
                                              {"sourceGamma", &TableSizes::sourceGamma, 2, 256},
                                              {"sourcePsi", &TableSizes::sourcePsi, 2, 256},
                                              {"solverPanels", &TableSizes::solverPanels, 2, 256},
                                              {"viewPanels", &TableSizes::viewPanels, 2, 256}};

/// Any device has other limits: checkSizes.
inline constexpr uint32_t kMostTexels = 1u << 20;
inline constexpr SizeField kStandardFields[] = {
    {"transmittanceMu", &TableSizes::transmittanceMu, 2, kMostTexels},
    {"transmittanceR", &TableSizes::transmittanceR, 2, kMostTexels},
    {"irradianceMuS", &TableSizes::irradianceMuS, 2, kMostTexels},
    {"irradianceR", &TableSizes::irradianceR, 2, kMostTexels},
    {"scatteringR", &TableSizes::scatteringR, 2, kMostTexels},
    {"scatteringMu", &TableSizes::scatteringMu, 4, kMostTexels},
    {"scatteringMuS", &TableSizes::scatteringMuS, 2, kMostTexels},
    {"scatteringNu", &TableSizes::scatteringNu, 2, kMostTexels}};

inline constexpr SizeField kModelFields[] = {
    {"stepCount", &TableSizes::stepCount, 1, kMaxStepCount}};

// None is forgotten.
static_assert(sizeof(TableSizes) ==
              (std::size(kMomentFields) + std::size(kStandardFields) + std::size(kModelFields)) *
                  sizeof(uint32_t));

}  // namespace alpenglow::tables
