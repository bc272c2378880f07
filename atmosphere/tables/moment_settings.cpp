// How fine the moment solver works: a level's settings, raised by the class of the medium.
#include <algorithm>
#include <cmath>

#include "atmosphere/tables/moment_shape.h"
#include "atmosphere/tables/size_fields.h"

namespace alpenglow {
namespace tables {
namespace {

// Draft ... Ultra. In the order of TableSizes: depthMu, depthH; nodesR, nodesMuS; zenithsSky,
// zenithsLimb, zenithsGround; azimuths, degree; sourceGamma, sourcePsi; solverPanels, viewPanels.
constexpr TableSizes kLevels[] = {{128, 64, 10, 28, 8, 4, 5, 8, 8, 24, 12, 4, 4},
                                  {192, 96, 12, 40, 10, 5, 6, 10, 10, 32, 16, 4, 5},
                                  {256, 128, 15, 52, 12, 5, 6, 12, 14, 40, 24, 4, 6},
                                  {384, 192, 22, 84, 18, 8, 10, 18, 18, 56, 32, 6, 8},
                                  {512, 256, 28, 112, 24, 10, 14, 24, 24, 60, 32, 8, 12}};

// Zenith optical depths of what scatters, each in the channel where it is greatest.
struct ZenithDepth {
  double molecules = 0.0, all = 0.0;
};

ZenithDepth zenithDepth(const Parameters& p) {
  ZenithDepth depth;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    const double molecules =
        p.rayleigh.present ? p.rayleigh.scattering_per_m[i] * p.rayleigh.scaleHeight_m : 0.0;
    const double aerosols = p.mie.present ? p.mie.scattering_per_m[i] * p.mie.scaleHeight_m : 0.0;
    depth.molecules = std::max(depth.molecules, molecules);
    depth.all = std::max(depth.all, molecules + aerosols);
  }
  return depth;
}

// Six classes of media by how often light is scattered in it.
constexpr double kDepthLimits[] = {0.35, 0.7, 1.5, 4.0, 12.0};
/// Orders that are solved one by one.
constexpr uint32_t kOrders[] = {5, 10, 12, 18, 26, 32};

uint32_t depthClass(const Parameters& p) {
  const double depth = zenithDepth(p).all;
  uint32_t result = 0;
  for (double limit : kDepthLimits) result += depth > limit ? 1 : 0;
  return result;
}

// Four classes by how narrow the aerosols' forward peak is.
struct PeakClass {
  double asymmetry;                                              ///< Up to this.
  uint32_t degree, azimuths, zenithsSky, sourceGamma, nodesMuS;  ///< Added to the level's.
  double taper;                                                  ///< MomentShape::taper.
};
constexpr PeakClass kPeakClasses[] = {{0.80, 0, 0, 0, 0, 0, 0.0},
                                      {0.88, 8, 8, 4, 12, 16, 0.0},
                                      {0.95, 33, 20, 14, 16, 12, 4.0},
                                      {1.00, 33, 20, 18, 16, 12, 4.0}};

const PeakClass& peakClass(const Parameters& p) {
  double asymmetry = p.mie.present ? std::abs(p.mie.asymmetry) : 0.0;
  // Without molecules nothing veils the little that is scattered back, where a series that is cut
  // few azimuths.
  const ZenithDepth depth = zenithDepth(p);
  if (depth.molecules < 0.1 * depth.all) asymmetry = std::cbrt(asymmetry * asymmetry);
  const PeakClass* result = kPeakClasses;
  while (asymmetry > result->asymmetry) ++result;
  return *result;
}

// More panels for a high, thin shell: two for each doubling beyond 64 scale heights.
uint32_t segmentPanels(const Parameters& p) {
  double least = p.topRadius_m - p.bottomRadius_m;
  const double thickness = least;
  if (p.rayleigh.present) least = std::min(least, p.rayleigh.scaleHeight_m);
  if (p.mie.present) least = std::min(least, p.mie.scaleHeight_m);
  const double doublings = std::log2(thickness / (64.0 * least));
  return static_cast<uint32_t>(std::ceil(2.0 * std::clamp(doublings, 0.0, 12.0)));
}

}  // namespace

uint32_t solvedOrders(const Parameters& parameters, const TableDesc& desc) {
  return desc.orders != 0 ? desc.orders : kOrders[depthClass(parameters)];
}

double degreeTaper(const Parameters& parameters) { return peakClass(parameters).taper; }

TableSizes momentSizes(const Parameters& parameters, Quality quality, const TableSizes& given) {
  const auto last = static_cast<uint32_t>(Quality::Ultra);
  const uint32_t level = quality == Quality::Default ? static_cast<uint32_t>(Quality::Medium)
                                                     : static_cast<uint32_t>(quality);
  TableSizes result = kLevels[std::min(level, last) - 1];
  const PeakClass& peak = peakClass(parameters);
  const uint32_t panels = depthClass(parameters) + segmentPanels(parameters);
  result.degree = std::min(result.degree + peak.degree, kMaxDegree);
  result.azimuths += peak.azimuths;
  result.zenithsSky += peak.zenithsSky;
  result.sourceGamma += peak.sourceGamma;
  result.nodesMuS += peak.nodesMuS;
  result.solverPanels += panels;
  result.viewPanels += panels;
  for (const SizeField& field : kMomentFields)
    if (given.*field.member != 0) result.*field.member = given.*field.member;
  return result;
}

}  // namespace tables
}  // namespace alpenglow
