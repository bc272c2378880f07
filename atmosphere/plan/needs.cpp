// What a host may ask of a plan.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/plan/rules.h"

namespace alpenglow::plan {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2.0;
constexpr SeenFlags kAllSeen = kSeenSky | kSeenGround | kSeenTerrain | kSeenSpace | kSeenSun;

struct Field {
  const char* name;
  double value, least, most;
};

Status wrong(model::Sentence* why, const char* field, double value, const char* mustBe) {
  *why << "Needs::" << field << " is " << value << ", but must be " << mustBe << ".";
  return Status::InvalidArgument;
}

Status checkRanges(const Needs& n, model::Sentence* why) {
  if (n.altitudeTo_m != 0.0 && n.altitudeTo_m < n.altitudeFrom_m)
    return wrong(why, "altitudeTo_m", n.altitudeTo_m, "at least altitudeFrom_m, or 0 for no limit");
  if (n.sunElevationTo < n.sunElevationFrom)
    return wrong(why, "sunElevationTo", n.sunElevationTo, "at least sunElevationFrom");
  if (n.sunFixed && n.sunElevationTo != n.sunElevationFrom)
    return wrong(why, "sunElevationTo", n.sunElevationTo, "sunElevationFrom where sunFixed is set");
  return Status::Ok;
}

}  // namespace

Status checkNeeds(const Needs& n, model::Sentence* why) {
  const Field fields[] = {{"altitudeFrom_m", n.altitudeFrom_m, 0.0, 1e12},
                          {"altitudeTo_m", n.altitudeTo_m, 0.0, 1e12},
                          {"sunElevationFrom", n.sunElevationFrom, -kRightAngle, kRightAngle},
                          {"sunElevationTo", n.sunElevationTo, -kRightAngle, kRightAngle},
                          {"sunDiscRadius", n.sunDiscRadius, 0.0, kRightAngle},
                          {"exposureTo", n.exposureTo, 0.0, 1e300},
                          {"error", n.error, 0.0, 1.0},
                          {"budgetSeconds", n.budgetSeconds, 0.0, 1e300},
                          {"secondsPerUnit", n.secondsPerUnit, 0.0, 1e300}};
  for (const Field& field : fields) {
    if (field.value >= field.least && field.value <= field.most) continue;
    *why << "Needs::" << field.name << " is " << field.value << ", but must be from " << field.least
         << " to " << field.most << ".";
    return Status::InvalidArgument;
  }
  if ((n.seen & ~kAllSeen) != 0)
    return wrong(why, "seen", n.seen, "bits of Seen, or 0 for anything");
  if (n.projection > Projection::Orthographic)
    return wrong(why, "projection", static_cast<uint32_t>(n.projection), "at most 2");
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    if (n.effects[i] <= Force::Off) continue;
    *why << "Needs::effects has " << static_cast<uint32_t>(n.effects[i]) << " for "
         << effectName(static_cast<Effect>(i)) << ", but must have Auto, On or Off.";
    return Status::InvalidArgument;
  }
  return checkRanges(n, why);
}

Status checkBase(const Needs& needs, const TableDesc& base, model::Sentence* why) {
  if (base.quality > Quality::Ultra || base.format > TableFormat::Float ||
      base.solver > Solver::Hillaire || base.mie > MieStorage::Packed) {
    *why << "TableDesc has solver " << static_cast<uint32_t>(base.solver) << ", format "
         << static_cast<uint32_t>(base.format) << ", mie " << static_cast<uint32_t>(base.mie)
         << " and quality " << static_cast<uint32_t>(base.quality)
         << ", but these enumerations end at 5, 1, 1 and 5.";
    return Status::InvalidArgument;
  }
  if ((base.disabledEffects & ~kTableEffects) != 0) {
    *why << "TableDesc::disabledEffects is " << base.disabledEffects << ", but may have bits of kTableEffects, "
         << kTableEffects << ", alone.";
    return Status::InvalidArgument;
  }
  const bool single = needs.effects[uint32_t(Effect::MultipleScattering)] == Force::Off ||
                      !hasEffect(base.disabledEffects, Effect::MultipleScattering);
  if (single && base.orders > 1) {
    *why << "TableDesc::orders is " << base.orders
         << ", but multiple_scattering is off, which leaves order 1: give 0 or 1.";
    return Status::InvalidArgument;
  }
  if (base.solver == Solver::Moments) return Status::Ok;
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    const auto effect = static_cast<Effect>(i);
    if ((kTableEffects & effectBit(effect)) == 0 || needs.effects[i] != Force::Off) continue;
    *why << "Needs::effects turns " << effectName(effect)
         << " off, but only tables of Solver::Moments may be without it.";
    return Status::InvalidArgument;
  }
  return Status::Ok;
}

double wantedError(const Needs& needs) { return needs.error > 0.0 ? needs.error : 0.01; }

bool limitsSun(const Needs& needs) {
  return needs.sunFixed || needs.sunElevationFrom != 0.0 || needs.sunElevationTo != 0.0;
}

double lowestSun() { return -kRightAngle; }

SunRange sunRange(const Needs& needs) {
  if (!limitsSun(needs)) return {-kRightAngle, kRightAngle};
  return {needs.sunElevationFrom, needs.sunElevationTo};
}

bool mayBeInSpace(const Air& air, const Needs& needs) {
  return needs.altitudeTo_m == 0.0 || needs.altitudeTo_m > air.thickness_m;
}

bool sees(const Needs& needs, Seen what) { return needs.seen == 0 || (needs.seen & what) != 0; }

void copyReason(const model::Sentence& sentence, EffectChoice* choice) {
  sentence.copyTo(choice->reason, sizeof choice->reason);
}

PlanChoice* addChoice(Plan* plan, const char* name, const model::Sentence& value,
                      const model::Sentence& reason) {
  PlanChoice* choice = &plan->choices[plan->choiceCount++];
  choice->name = name;
  value.copyTo(choice->value, sizeof choice->value);
  reason.copyTo(choice->reason, sizeof choice->reason);
  return choice;
}

}  // namespace alpenglow::plan
