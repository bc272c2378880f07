#include "atmosphere/bake/pass.h"

#include <cstdio>

namespace alpenglow::bake {
namespace {

constexpr PassIo kPassIo[kPassKindCount] = {
    {{kNoImage}, {kOpticalDepth, kNoImage, kNoImage}, false},
    {{kOpticalDepth, kNoImage}, {kDeltaIrradiance, kIrradiance, kNoImage}, false},
    {{kOpticalDepth, kNoImage}, {kDeltaScattering, kDeltaMie, kScattering}, false},
    {{kDeltaScattering, kDeltaMie, kNoImage}, {kIncident, kIncidentMie, kNoImage}, false},
    {{kOpticalDepth, kDeltaIrradiance, kIncident, kIncidentMie, kNoImage},
     {kDeltaSource, kNoImage, kNoImage},
     false},
    {{kDeltaScattering, kDeltaMie, kNoImage}, {kDeltaIrradiance, kIrradiance, kNoImage}, true},
    {{kOpticalDepth, kDeltaSource, kNoImage}, {kDeltaScattering, kScattering, kNoImage}, true},
};

// Table fetches of one texel, from the loops of shaders/glsl/physics/standard.glsl. T fetches
// nothing; a trapezoid of it takes about as long as 0.4 fetches.
uint64_t unitsPerTexel(PassKind kind, bool firstOrder) {
  switch (kind) {
    case PassKind::OpticalDepth:
      return 200;
    case PassKind::DirectIrradiance:
      return 1;
    case PassKind::SingleScattering:
      return 51 * 3;
    case PassKind::IncidentRadiance:
      return 4;
    case PassKind::ScatteringDensity:
      return kSphereTheta * 2 * kSphereTheta * (firstOrder ? 2 : 1) * 3 / 2;  // half see the ground
    case PassKind::DiffuseIrradiance:
      return 16 * 64 * (firstOrder ? 4 : 2);
    case PassKind::MultipleScattering:
      return 51 * 4;
  }
  return 1;
}

Pass makePass(const TableSizes& sizes, PassKind kind, uint32_t order, const char* symbol) {
  Pass pass;
  pass.kind = kind;
  pass.order = order;
  pass.firstOrder = order == 2;
  if (order == 0) {
    std::snprintf(pass.name, sizeof pass.name, "%s", symbol);
  } else {
    std::snprintf(pass.name, sizeof pass.name, "%s %u", symbol, order);
  }
  switch (kind) {
    case PassKind::OpticalDepth:
      pass.width = sizes.transmittanceMu;
      pass.height = pass.rows = sizes.transmittanceR;
      break;
    case PassKind::DirectIrradiance:
    case PassKind::DiffuseIrradiance:
      pass.width = sizes.irradianceMuS;
      pass.height = pass.rows = sizes.irradianceR;
      break;
    case PassKind::IncidentRadiance:
      pass.width = sizes.scatteringNu * kSphereTheta;
      pass.height = pass.rows = sizes.scatteringMuS * sizes.scatteringR;
      break;
    default:
      pass.width = sizes.scatteringMuS * sizes.scatteringNu;
      pass.height = sizes.scatteringMu;
      pass.rows = sizes.scatteringMu * sizes.scatteringR;
      break;
  }
  pass.unitsPerRow = pass.width * unitsPerTexel(kind, pass.firstOrder);
  return pass;
}

}  // namespace

const PassIo& passIo(PassKind kind) { return kPassIo[static_cast<uint32_t>(kind)]; }

std::vector<Pass> standardPasses(const TableSizes& sizes, uint32_t orders) {
  std::vector<Pass> passes;
  passes.push_back(makePass(sizes, PassKind::OpticalDepth, 0, "T"));
  passes.push_back(makePass(sizes, PassKind::DirectIrradiance, 1, "dE"));
  passes.push_back(makePass(sizes, PassKind::SingleScattering, 1, "dS"));
  for (uint32_t order = 2; order <= orders; ++order) {
    passes.push_back(makePass(sizes, PassKind::IncidentRadiance, order, "dL"));
    passes.push_back(makePass(sizes, PassKind::ScatteringDensity, order, "dJ"));
    passes.push_back(makePass(sizes, PassKind::DiffuseIrradiance, order, "dE"));
    passes.push_back(makePass(sizes, PassKind::MultipleScattering, order, "dS"));
  }
  return passes;
}

}  // namespace alpenglow::bake
