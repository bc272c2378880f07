// How fine the moment solver works: a level's settings, raised by the class of the air.
#include <algorithm>
#include <cmath>

#include "atmosphere/bake/moment_shape.h"

namespace alpenglow {
namespace bake {
namespace {

// Draft ... Ultra. In the order of MomentSettings: depthMu, depthH; nodesR, nodesMuS; ringsSky,
// ringsLimb, ringsGround; azimuths, degree; sourceGamma, sourcePsi; solverPanels, viewPanels.
constexpr MomentSettings kLevels[] = {{128, 64, 8, 24, 8, 4, 4, 8, 8, 24, 8, 3, 5},
                                      {192, 96, 12, 32, 10, 5, 6, 10, 10, 24, 12, 4, 6},
                                      {256, 128, 16, 48, 14, 6, 8, 14, 14, 32, 16, 5, 8},
                                      {256, 128, 20, 64, 18, 8, 10, 18, 18, 40, 20, 6, 10},
                                      {384, 192, 24, 96, 24, 10, 14, 24, 24, 48, 24, 8, 14}};

// Zenith optical depth of all that scatters, in the channel where it is greatest.
double scatteringDepth(const Parameters& p) {
  double most = 0.0;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    const double molecules =
        p.rayleigh.present ? p.rayleigh.scattering_per_m[i] * p.rayleigh.scaleHeight_m : 0.0;
    const double aerosols = p.mie.present ? p.mie.scattering_per_m[i] * p.mie.scaleHeight_m : 0.0;
    most = std::max(most, molecules + aerosols);
  }
  return most;
}

// Six classes of air by how often light is scattered in it.
uint32_t depthClass(const Parameters& p) {
  constexpr double kLimits[] = {0.5, 1.0, 2.0, 5.0, 15.0};
  uint32_t result = 0;
  for (double limit : kLimits) result += scatteringDepth(p) > limit ? 1 : 0;
  return result;
}

// Four classes by how narrow the aerosols' forward peak is.
uint32_t peakClass(const Parameters& p) {
  constexpr double kLimits[] = {0.8, 0.88, 0.95};
  uint32_t result = 0;
  for (double limit : kLimits) result += p.mie.present && std::abs(p.mie.asymmetry) > limit ? 1 : 0;
  return result;
}

}  // namespace

uint32_t solvedOrders(const Parameters& parameters, const TableDesc& desc) {
  constexpr uint32_t kOrders[] = {5, 7, 10, 16, 24, 32};
  return desc.orders != 0 ? desc.orders : kOrders[depthClass(parameters)];
}

}  // namespace bake

inline namespace v1 {

MomentSettings momentSettings(const Parameters& parameters, Quality quality,
                              const MomentSettings& custom) {
  const auto last = static_cast<uint32_t>(Quality::Ultra);
  const uint32_t level = quality == Quality::Default ? static_cast<uint32_t>(Quality::Medium)
                                                     : static_cast<uint32_t>(quality);
  MomentSettings result = bake::kLevels[std::min(level, last) - 1];
  const uint32_t peak = bake::peakClass(parameters), depth = bake::depthClass(parameters);
  result.degree = std::min(result.degree + 6 * peak, kMaxDegree);
  result.azimuths += 6 * peak;
  result.solverPanels += 2 * depth;
  result.viewPanels += 3 * depth;
  const uint32_t* given = &custom.depthMu;
  uint32_t* out = &result.depthMu;
  for (size_t i = 0; i < sizeof(MomentSettings) / sizeof(uint32_t); ++i)
    if (given[i] != 0) out[i] = given[i];
  return result;
}

}  // namespace v1
}  // namespace alpenglow
