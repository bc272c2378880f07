// Checks of PlanRequest.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "atmosphere/plan/rules.h"

namespace alpenglow::plan {
namespace {

constexpr double kRightAngle = std::numbers::pi / 2.0;
constexpr VisibilityFlags kAllVisible =
    kVisibleSky | kVisibleGround | kVisibleScene | kVisibleSpace | kVisibleSun;

struct Field {
  const char* name;
  double value, least, most;
};

Status wrong(parameters::Sentence* why, const char* field, double value, const char* mustBe) {
  *why << "PlanRequest::" << field << " is " << value << ", but must be " << mustBe << ".";
  return Status::InvalidArgument;
}

Status checkRanges(const PlanRequest& n, parameters::Sentence* why) {
  if (n.altitudeTo_m != 0.0 && n.altitudeTo_m < n.altitudeFrom_m)
    return wrong(why, "altitudeTo_m", n.altitudeTo_m, "at least altitudeFrom_m, or 0 for no limit");
  if (n.sunElevationTo < n.sunElevationFrom)
    return wrong(why, "sunElevationTo", n.sunElevationTo, "at least sunElevationFrom");
  if (n.sunFixed && n.sunElevationTo != n.sunElevationFrom)
    return wrong(why, "sunElevationTo", n.sunElevationTo, "sunElevationFrom where sunFixed is set");
  return Status::Ok;
}

}  // namespace

Status checkRequest(const PlanRequest& n, parameters::Sentence* why) {
  const Field fields[] = {{"altitudeFrom_m", n.altitudeFrom_m, 0.0, 1e12},
                          {"altitudeTo_m", n.altitudeTo_m, 0.0, 1e12},
                          {"casterAltitude_m", n.casterAltitude_m, 0.0, 1e12},
                          {"sunElevationFrom", n.sunElevationFrom, -kRightAngle, kRightAngle},
                          {"sunElevationTo", n.sunElevationTo, -kRightAngle, kRightAngle},
                          {"sunDiscRadius", n.sunDiscRadius, 0.0, kRightAngle},
                          {"exposure", n.exposure, 0.0, 1e300},
                          {"errorTarget", n.errorTarget, 0.0, 1.0},
                          {"budgetSeconds", n.budgetSeconds, 0.0, 1e300},
                          {"secondsPerUnit", n.secondsPerUnit, 0.0, 1e300}};
  for (const Field& field : fields) {
    if (field.value >= field.least && field.value <= field.most) continue;
    *why << "PlanRequest::" << field.name << " is " << field.value << ", but must be from "
         << field.least << " to " << field.most << ".";
    return Status::InvalidArgument;
  }
  if ((n.visible & ~kAllVisible) != 0)
    return wrong(why, "visible", n.visible, "bits of VisibilityFlag, or 0 for anything");
  if (n.view.projection > Projection::Orthographic)
    return wrong(why, "projection", static_cast<uint32_t>(n.view.projection), "at most 2");
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    if (n.effects[i] <= Force::Off) continue;
    *why << "PlanRequest::effects has " << static_cast<uint32_t>(n.effects[i]) << " for "
         << effectName(static_cast<Effect>(i)) << ", but must have Auto, On or Off.";
    return Status::InvalidArgument;
  }
  return checkRanges(n, why);
}

Status checkTables(const PlanRequest& request, parameters::Sentence* why) {
  const TableDesc& base = request.tables;
  const bool single = request.effects[uint32_t(Effect::MultipleScattering)] == Force::Off ||
                      !hasEffect(base.disabledEffects, Effect::MultipleScattering);
  if (single && base.orders > 1) {
    *why << "TableDesc::orders is " << base.orders
         << ", but multiple_scattering is off, which leaves order 1: give 0 or 1.";
    return Status::InvalidArgument;
  }
  if (base.solver == Solver::Moments) return Status::Ok;
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    const auto effect = static_cast<Effect>(i);
    if ((kTableEffects & effectBit(effect)) == 0 || request.effects[i] != Force::Off) continue;
    *why << "PlanRequest::effects turns " << effectName(effect)
         << " off, but only tables of Solver::Moments may disable it.";
    return Status::InvalidArgument;
  }
  return Status::Ok;
}

double wantedError(const PlanRequest& request) {
  return request.errorTarget > 0.0 ? request.errorTarget : 0.01;
}

bool limitsSun(const PlanRequest& request) {
  return request.sunFixed || request.sunElevationFrom != 0.0 || request.sunElevationTo != 0.0;
}

double lowestSun() { return -kRightAngle; }

SunRange sunRange(const PlanRequest& request) {
  if (!limitsSun(request)) return {-kRightAngle, kRightAngle};
  return {request.sunElevationFrom, request.sunElevationTo};
}

bool mayBeInSpace(const MediumTraits& medium, const PlanRequest& request) {
  return request.altitudeTo_m == 0.0 || request.altitudeTo_m > medium.thickness_m;
}

bool sees(const PlanRequest& request, VisibilityFlag what) {
  return request.visible == 0 || (request.visible & what) != 0;
}

void copyReason(const parameters::Sentence& sentence, PlanChoice* choice) {
  sentence.copyTo(choice->reason, sizeof choice->reason);
}

PlanChoice* addChoice(Plan* plan, const char* name, const parameters::Sentence& value,
                      const parameters::Sentence& reason) {
  PlanChoice* choice = &plan->choices[plan->choiceCount++];
  (parameters::Sentence() << name).copyTo(choice->name, sizeof choice->name);
  value.copyTo(choice->value, sizeof choice->value);
  choice->on = true;
  copyReason(reason, choice);
  return choice;
}

}  // namespace alpenglow::plan
