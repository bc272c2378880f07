// Whether a plan covers another request, and what must be recreated when it doesn't.
#include <algorithm>
#include <cstring>
#include <iterator>
#include <type_traits>

#include "atmosphere/plan/rules.h"

namespace alpenglow {
namespace {

using plan::isOn;

bool coversCamera(const Plan& plan, const PlanRequest& request) {
  const double most = plan.request.altitudeTo_m;
  const bool higher = request.altitudeTo_m == 0.0 || request.altitudeTo_m > most;
  return (most == 0.0 || !higher) && request.view.projection == plan.request.view.projection;
}

bool coversSun(const Plan& plan, const PlanRequest& request) {
  const plan::SunRange has = plan::sunRange(plan.request), asked = plan::sunRange(request);
  if (asked.from < has.from || asked.to > has.to) return false;
  const double most = plan.request.exposure;
  const bool brighter = most != 0.0 && (request.exposure == 0.0 || request.exposure > most);
  return !brighter || (isOn(plan, Effect::Twilight) && isOn(plan, Effect::Night));
}

bool coversScene(const Plan& plan, const PlanRequest& request) {
  constexpr VisibilityFlag kAll[] = {kVisibleSky, kVisibleGround, kVisibleScene, kVisibleSpace,
                                     kVisibleSun};
  for (const VisibilityFlag what : kAll) {
    if (plan::sees(request, what) && !plan::sees(plan.request, what)) return false;
  }
  const bool disc = request.sunDiscRadius > 0.0 && plan.request.sunDiscRadius == 0.0;
  const double top = plan.request.casterAltitude_m;
  const bool casters =
      plan.request.casters &&
      (top == 0.0 || (request.casterAltitude_m > 0.0 && request.casterAltitude_m <= top));
  return !disc && (!request.casters || casters);
}

bool coversWishes(const Plan& plan, const PlanRequest& request) {
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    const PlanChoice& choice = plan.choices[i];
    const Force force = request.effects[i];
    if (force == plan.request.effects[i]) continue;
    // A forced-off effect is needed again as soon as it is no longer forced.
    const bool lacks = !choice.on && (force == Force::On || choice.forced);
    if (lacks || (choice.on && force == Force::Off)) return false;
  }
  const double error = plan::wantedError(request);
  return error >= plan::wantedError(plan.request) || plan.expectedError <= error;
}

bool sameLight(const LightDesc& a, const LightDesc& b) {
  return a.kind == b.kind && std::equal(std::begin(a.irradiance.value),
                                        std::end(a.irradiance.value), b.irradiance.value);
}

/// The tables that the host requests, without the members that a plan decides.
bool sameShape(const TableDesc& a, const TableDesc& b) {
  static_assert(std::has_unique_object_representations_v<TableSizes>);
  return a.keepOrders == b.keepOrders && a.cpuQueries == b.cpuQueries &&
         a.readerStages == b.readerStages &&
         std::equal(std::begin(a.lights), std::end(a.lights), std::begin(b.lights), sameLight) &&
         std::memcmp(&a.sizes, &b.sizes, sizeof a.sizes) == 0;
}

bool coversTables(const TableDesc& has, const TableDesc& asked) {
  return has.solver == asked.solver && has.orders == asked.orders && has.format == asked.format &&
         has.quality == asked.quality && has.mie == asked.mie &&
         has.disabledEffects == asked.disabledEffects && has.sunZenithFrom == asked.sunZenithFrom &&
         has.sunZenithTo == asked.sunZenithTo && sameShape(has, asked);
}

bool covers(const Plan& plan, const PlanRequest& request) {
  return coversCamera(plan, request) && coversSun(plan, request) && coversScene(plan, request) &&
         coversWishes(plan, request) && coversTables(plan.request.tables, request.tables);
}

bool holdsSuns(const TableDesc& has, const TableDesc& asked) {
  const auto any = [](const TableDesc& d) {
    return d.sunZenithFrom == 0.0 && d.sunZenithTo == 0.0;
  };
  if (any(has)) return true;
  return !any(asked) && has.sunZenithFrom <= asked.sunZenithFrom &&
         has.sunZenithTo >= asked.sunZenithTo;
}

const char* tableChange(const Plan& has, const Plan& asked) {
  const TableDesc &a = has.tables, &b = asked.tables;
  if (a.solver != b.solver || a.format != b.format || a.mie != b.mie)
    return "The tables are of another solver or format.";
  if (!sameShape(has.request.tables, asked.request.tables))
    return "The tables have other sizes than are given.";
  if (!holdsSuns(a, b)) return "The tables don't cover all requested sun elevations.";
  if ((a.disabledEffects & ~b.disabledEffects) != 0)
    return "The tables lack an effect that is enabled now.";
  const bool forced = ((b.disabledEffects & ~a.disabledEffects) & kTableEffects) != 0;
  if (forced) {
    for (uint32_t i = 0; i < kEffectCount; ++i) {
      const bool off =
          (b.disabledEffects & ~a.disabledEffects & effectBit(static_cast<Effect>(i))) != 0;
      if (off && asked.choices[i].forced)
        return "The tables hold an effect that has been turned off.";
    }
  }
  if (plan::levelOf(a.quality) < plan::levelOf(b.quality))
    return "The tables are of a lower quality than is wanted.";
  if (a.orders != b.orders && !(a.orders == 0 && !isOn(asked, Effect::MultipleScattering)))
    return "The tables have other orders.";
  return nullptr;
}

const char* viewChange(const Plan& has, const Plan& asked) {
  if (has.request.view.projection != asked.request.view.projection)
    return "The view has another projection.";
  if ((has.view.disabledEffects & ~asked.view.disabledEffects & kViewEffects) != 0)
    return "The view lacks an effect that is enabled now.";
  if (plan::drawsAerial(asked) && !plan::drawsAerial(has))
    return "The view draws no aerial perspective.";
  if (plan::drawsFromLut(has) && !plan::drawsFromLut(asked))
    return "The view draws from its LUT alone.";
  return nullptr;
}

const char* lightShaftChange(const Plan& has, const Plan& asked) {
  if (!plan::drawsLightShafts(asked)) return nullptr;
  if (!plan::drawsLightShafts(has)) return "Light shafts are on now.";
  if (has.view.lightShafts.method != asked.view.lightShafts.method)
    return "Light shafts have another method.";
  return nullptr;
}

}  // namespace

inline namespace v1_0 {

RecreateFlags comparePlans(const Plan& current, const Plan& next, const DiagnosticSink& sink) {
  if (covers(current, next.request)) return 0;
  const char* tables = tableChange(current, next);
  const char* view = viewChange(current, next);
  if (view == nullptr) view = lightShaftChange(current, next);
  const TableDesc &a = current.tables, &b = next.tables;
  // A view is made for one kind of tables.
  const bool other = a.disabledEffects != b.disabledEffects || a.solver != b.solver ||
                     a.mie != b.mie || plan::levelOf(a.quality) != plan::levelOf(b.quality);
  RecreateFlags flags = 0;
  if (tables != nullptr) flags |= kRecreateTables;
  if (view != nullptr || (tables != nullptr && other)) flags |= kRecreateView;
  const char* why = tables != nullptr ? tables : view;
  if (why != nullptr && sink.report != nullptr)
    sink.report(sink.user, {Severity::Info, Status::Ok, VK_SUCCESS, why});
  return flags;
}

}  // namespace v1_0
}  // namespace alpenglow
