// Quality level and orders from the wanted error, by measured tables; the other choices in words.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "atmosphere/plan/rules.h"

namespace alpenglow::plan {
namespace {

constexpr uint32_t kLevels = 5, kBands = 5;
constexpr const char* kNames[kLevels] = {"draft", "low", "medium", "high", "ultra"};

/// 95th percentiles by level and band (day, low, civil, nautical, astronomical), per cent:
/// docs/accuracy.md. A level counts with at least the error of the finer ones.
struct Measured {
  const char* medium;
  double percent[kLevels][kBands];
};
constexpr Measured kClear = {"clear air",
                             {{0.78, 2.35, 3.36, 4.58, 5.91},
                              {0.41, 0.98, 1.50, 3.54, 5.09},
                              {0.30, 0.38, 0.79, 2.35, 3.88},
                              {0.24, 0.25, 0.57, 1.95, 3.88},
                              {0.24, 0.23, 0.57, 1.41, 3.88}}};
/// The worse of earth-hazy and mars.
constexpr Measured kHazy = {"haze",
                            {{1.26, 2.53, 6.25, 5.06, 11.04},
                             {0.82, 1.68, 4.68, 4.92, 11.04},
                             {0.51, 1.29, 4.17, 4.92, 11.04},
                             {0.41, 1.11, 3.95, 4.92, 10.61},
                             {0.41, 1.11, 3.89, 4.92, 10.55}}};
/// haze85.
constexpr Measured kNarrow = {"haze of g up to 0.88",
                              {{1.85, 3.36, 8.23, 5.18, 8.89},
                               {0.96, 2.16, 8.23, 4.92, 7.03},
                               {0.64, 1.44, 3.01, 4.92, 4.73},
                               {0.49, 0.93, 2.80, 4.33, 4.55},
                               {0.49, 0.75, 1.98, 4.33, 4.30}}};
/// Media of which only Quality::Medium was measured (haze93; thick5 and mie-only), or none like it:
/// haze85's errors times the worst ratio of these to haze85's, band by band.
constexpr double kUnknown[kBands] = {3.7, 3.2, 2.1, 2.3, 2.4};
/// The sky-view LUT's own share (docs/luts.md).
constexpr double kLut[kLevels] = {0.64, 0.27, 0.09, 0.09, 0.09};

struct Band {
  double from, to;  ///< Degrees of elevation.
};
constexpr Band kBandEnds[kBands] = {{10, 91}, {0, 10}, {-6, 0}, {-12, -6}, {-18, -12}};

uint32_t indexOf(Quality quality) { return static_cast<uint32_t>(levelOf(quality)) - 1; }

struct Class {
  const Measured* measured;
  bool known;
};

Class classOf(const Parameters& parameters) {
  const MediumTraits medium = mediumTraits(parameters);
  const bool molecules = parameters.rayleigh.present;
  if (!molecules || medium.scattering > 4.0 || medium.peakAsymmetry > 0.88)
    return {&kNarrow, false};
  if (medium.peakAsymmetry > 0.80) return {&kNarrow, true};
  if (medium.scattering > 0.35 || !medium.likeEarth) return {&kHazy, true};
  return {&kClear, true};
}

double errorOf(const Parameters& parameters, const Plan& plan, uint32_t level) {
  const Class medium = classOf(parameters);
  const SunRange elevations = widened(parameters, plan.request);
  // Invisible light has no error.
  const bool dark = isOn(plan, Effect::Twilight) || isOn(plan, Effect::Night);
  const double from =
      dark ? elevations.from : std::max(elevations.from, std::min(0.0, elevations.to));
  double worst = 0.0;
  for (uint32_t band = 0; band < kBands; ++band) {
    const Band& ends = kBandEnds[band];
    const bool last = band + 1 == kBands;
    const bool reached = elevations.to >= ends.from * kDegree && from < ends.to * kDegree;
    const bool darker = last && elevations.to < ends.from * kDegree;
    if (!reached && !darker) continue;
    const double factor = medium.known ? 1.0 : kUnknown[band];
    worst = std::max(worst, medium.measured->percent[level][band] * factor);
  }
  return (worst + (drawsFromLut(plan) ? kLut[level] : 0.0)) / 100.0;
}

double percent(double share) { return std::round(share * 1e4) / 100.0; }
double degrees(double radians) { return std::round(radians / kDegree * 100.0) / 100.0; }

void describeSuns(Plan* plan) {
  const TableDesc& base = plan->request.tables;
  const TableDesc& desc = plan->tables;
  parameters::Sentence value, why;
  const bool any = desc.sunZenithFrom == 0.0 && desc.sunZenithTo == 0.0;
  if (any) {
    value << "any";
    why << (desc.solver == Solver::Moments
                ? "The sun's range, widened to the horizon's, leaves nothing out."
                : "Only tables of the solver moments can be limited to a range of sun elevations.");
  } else {
    value << degrees(desc.sunZenithFrom) << " to " << degrees(desc.sunZenithTo)
          << " degrees from the zenith";
    if (base.sunZenithFrom != 0.0 || base.sunZenithTo != 0.0) {
      why << "Given by the host.";
    } else {
      why << "The sun stays from " << degrees(plan->request.sunElevationFrom) << " to "
          << degrees(plan->request.sunElevationTo)
          << " degrees high, and places in view have it up to the horizon's arc off.";
    }
  }
  addChoice(plan, "sun_zenith", value, why);
}

void describeDepths(Plan* plan) {
  const TableDesc& base = plan->request.tables;
  const TableSizes& settings = plan->tables.sizes;
  if (settings.depthMu == base.sizes.depthMu && settings.depthH == base.sizes.depthH) return;
  parameters::Sentence value, why;
  value << settings.depthMu << " x " << settings.depthH;
  why << "Beside tables for a short range of sun elevations that of optical depths is the largest, "
         "and so many texels "
         "cost no accuracy that shows.";
  addChoice(plan, "optical_depths", value, why);
}

void describeAltitude(const Parameters& parameters, Plan* plan) {
  parameters::Sentence value, why;
  value << "0 to " << parameters.topRadius_m - parameters.bottomRadius_m << " m";
  why << "Light on a ray comes from all altitudes, so tables hold all of them.";
  addChoice(plan, "altitude", value, why);
}

void describeOrders(uint32_t solved, Plan* plan) {
  const TableDesc& base = plan->request.tables;
  parameters::Sentence value, why;
  const bool multiple = isOn(*plan, Effect::MultipleScattering) || base.orders > 1;
  if (base.solver != Solver::Moments && base.solver != Solver::Standard) return;
  if (base.orders != 0) {
    value << base.orders;
    why << "Given by the host.";
  } else if (!multiple && base.solver == Solver::Moments) {
    value << 1u;
    why << "Multiple scattering is off.";
  } else if (base.solver == Solver::Standard) {
    value << solved;
    why << "The default of the solver standard.";
  } else {
    value << "all";
    why << "In a medium of this depth " << solved
        << " orders are solved one by one; what follows is a geometric series.";
  }
  addChoice(plan, "orders", value, why);
}

void describeSkyViewLut(Plan* plan) {
  parameters::Sentence value, why;
  value << (drawsFromLut(*plan) ? "on" : "off");
  if (drawsFromLut(*plan)) {
    why << "A frame has more pixels than the LUT has rays, so light is looked up in it.";
  } else if (plan->request.view.projection == Projection::Orthographic) {
    why << "Each ray of an orthographic camera has an observer of its own.";
  } else {
    why << "This solver makes no sky-view LUT for cameras above the atmosphere.";
  }
  addChoice(plan, "sky_view_lut", value, why);
}

void describeLightShafts(Plan* plan) {
  if (!drawsLightShafts(*plan)) return;
  parameters::Sentence value, why;
  constexpr const char* kMethods[] = {"exact", "paper", "march"};
  value << kMethods[static_cast<uint32_t>(plan->view.lightShafts.method) - 1];
  why << "The light-volume mesh takes any casters and no steps along a ray.";
  addChoice(plan, "shafts", value, why);
}

void describeQuality(const Parameters& parameters, Quality unbound, Plan* plan) {
  const TableDesc& base = plan->request.tables;
  if (base.solver != Solver::Moments) return;
  const Class medium = classOf(parameters);
  const Quality level = levelOf(plan->tables.quality);
  const double wanted = percent(wantedError(plan->request));
  parameters::Sentence value, why;
  value << levelName(level);
  if (base.quality != Quality::Default) {
    why << "Given by the host";
  } else if (levelOf(unbound) != level) {
    why << "The budget lowers it from " << levelName(unbound);
  } else if (plan->errorMet) {
    why << "The lowest level that meets " << wanted << " %";
  } else {
    why << "No level up to it meets " << wanted << " %";
  }
  why << ": in " << medium.measured->medium << " its error at these sun elevations is "
      << (medium.known ? "up to " : "estimated as ") << percent(plan->expectedError) << " %.";
  addChoice(plan, "quality", value, why);
}

}  // namespace

Quality levelOf(Quality quality) { return quality == Quality::Default ? Quality::Medium : quality; }

const char* levelName(Quality quality) { return kNames[indexOf(quality)]; }

void setQuality(const Parameters& parameters, Quality quality, Plan* plan) {
  plan->tables.quality = quality;
  plan->expectedError = errorOf(parameters, *plan, indexOf(quality));
  plan->errorMet = plan->expectedError <= wantedError(plan->request);
}

void decideQuality(const Parameters& parameters, Plan* plan) {
  const TableDesc& base = plan->request.tables;
  plan->errorMet = true;  // No error is predicted for other solvers.
  if (base.solver != Solver::Moments) return;
  if (base.quality != Quality::Default) return setQuality(parameters, base.quality, plan);
  // Without a target at most the default level.
  const Quality finest = plan->request.errorTarget > 0.0 ? Quality::Ultra : Quality::Medium;
  for (Quality level = Quality::Draft; level <= finest;
       level = static_cast<Quality>(static_cast<uint32_t>(level) + 1)) {
    setQuality(parameters, level, plan);
    if (plan->errorMet) return;
  }
}

void fitDepths(Plan* plan) {
  const TableDesc& base = plan->request.tables;
  constexpr double kFewSuns = 20.0 * kDegree;
  TableDesc& desc = plan->tables;
  const bool few = desc.sunZenithTo > 0.0 && desc.sunZenithTo - desc.sunZenithFrom <= kFewSuns;
  const bool fine = levelOf(desc.quality) >= Quality::Medium;
  if (base.solver != Solver::Moments || !few || !fine) return;
  if (base.sizes.depthMu == 0) desc.sizes.depthMu = kFewDepthMu;
  if (base.sizes.depthH == 0) desc.sizes.depthH = kFewDepthH;
}

void describeChoices(const Parameters& parameters, uint32_t solvedOrders, Quality unbound,
                     Plan* plan) {
  plan->choiceCount = kEffectCount;
  describeSuns(plan);
  describeDepths(plan);
  describeAltitude(parameters, plan);
  describeQuality(parameters, unbound, plan);
  describeOrders(solvedOrders, plan);
  describeSkyViewLut(plan);
  describeLightShafts(plan);
}

}  // namespace alpenglow::plan
