// Whether a plan still serves, and what must be made anew when it doesn't.
#include <algorithm>

#include "atmosphere/plan/rules.h"

namespace alpenglow {
namespace {

using model::Sentence;

bool on(const Plan& plan, Effect effect) { return plan.effects[static_cast<uint32_t>(effect)].on; }

double degrees(double radians) { return radians / plan::kDegree; }

// Sentences about what a plan in use lacks; the first counts.
bool coversCamera(const Plan& plan, const Needs& needs, Sentence* why) {
  const double most = plan.needs.altitudeTo_m;
  if (most != 0.0 && (needs.altitudeTo_m == 0.0 || needs.altitudeTo_m > most)) {
    *why << "The camera may climb above " << most << " m, for which the plan was made.";
    return false;
  }
  if (needs.projection != plan.needs.projection) {
    *why << "The camera's projection is another.";
    return false;
  }
  return true;
}

bool coversSun(const Plan& plan, const Needs& needs, Sentence* why) {
  const plan::SunRange has = plan::sunRange(plan.needs), asked = plan::sunRange(needs);
  if (asked.from < has.from || asked.to > has.to) {
    *why << "The sun may stand from " << degrees(asked.from) << " to " << degrees(asked.to)
         << " degrees high, but the plan was made for " << degrees(has.from) << " to "
         << degrees(has.to) << ".";
    return false;
  }
  const double most = plan.needs.exposureTo;
  const bool brighter = most != 0.0 && (needs.exposureTo == 0.0 || needs.exposureTo > most);
  if (brighter && !(on(plan, Effect::Twilight) && on(plan, Effect::Night))) {
    *why << "The exposure may rise above " << most << ", up to which the plan's dark is black.";
    return false;
  }
  return true;
}

bool coversScene(const Plan& plan, const Needs& needs, Sentence* why) {
  constexpr struct {
    Seen what;
    const char* name;
  } kSeen[] = {{kSeenSky, "sky"},
               {kSeenGround, "ground"},
               {kSeenTerrain, "terrain"},
               {kSeenSpace, "space"},
               {kSeenSun, "the sun"}};
  for (const auto& seen : kSeen) {
    if (!plan::sees(needs, seen.what) || plan::sees(plan.needs, seen.what)) continue;
    *why << "What may come into view has " << seen.name << ", which the plan leaves out.";
    return false;
  }
  if (needs.sunDiscRadius > 0.0 && plan.needs.sunDiscRadius == 0.0) {
    *why << "The sun has a disc now, which the plan leaves out.";
    return false;
  }
  if (needs.occluders && !plan.needs.occluders) {
    *why << "Casters of light shafts have come, which the plan leaves out.";
    return false;
  }
  return true;
}

bool coversWishes(const Plan& plan, const Needs& needs, Sentence* why) {
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    const EffectChoice& choice = plan.effects[i];
    const Force force = needs.effects[i];
    if (force == plan.needs.effects[i]) continue;
    // What was turned off by hand may be wanted as soon as it isn't.
    const bool lacks = !choice.on && (force == Force::On || choice.forced);
    if (!lacks && !(choice.on && force == Force::Off)) continue;
    *why << "The effect " << effectName(static_cast<Effect>(i)) << " is "
         << (choice.on ? "on" : "off") << " in the plan, but is to be "
         << (force == Force::Auto ? "left to it"
             : force == Force::On ? "on"
                                  : "off")
         << ".";
    return false;
  }
  const double error = plan::wantedError(needs);
  if (error < plan::wantedError(plan.needs) && plan.expectedError > error) {
    *why << "An error of " << error << " is wanted, but the plan has one of " << plan.expectedError
         << ".";
    return false;
  }
  return true;
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
  const TableDesc &a = has.tableDesc, &b = asked.tableDesc;
  if (a.solver != b.solver || a.format != b.format || a.mie != b.mie)
    return "The tables are of another solver or format.";
  if (!holdsSuns(a, b)) return "The tables don't reach all suns that may come.";
  if ((a.disabledEffects & ~b.disabledEffects) != 0) return "The tables are without an effect that is on now.";
  const bool forced = ((b.disabledEffects & ~a.disabledEffects) & kTableEffects) != 0;
  if (forced) {
    for (uint32_t i = 0; i < kEffectCount; ++i) {
      const bool off = (b.disabledEffects & ~a.disabledEffects & effectBit(static_cast<Effect>(i))) != 0;
      if (off && asked.effects[i].forced)
        return "The tables hold an effect that has been turned off.";
    }
  }
  if (plan::levelOf(a.quality) < plan::levelOf(b.quality))
    return "The tables are of a lower quality than is wanted.";
  if (a.orders != b.orders && !(a.orders == 0 && asked.effects[3].on == false))
    return "The tables have other orders.";
  return nullptr;
}

const char* viewChange(const Plan& has, const Plan& asked) {
  if (has.needs.projection != asked.needs.projection) return "The view has another projection.";
  if ((has.viewWithout & ~asked.viewWithout & kViewEffects) != 0)
    return "The view is without an effect that is on now.";
  if (asked.sceneDepth && !has.sceneDepth) return "The view draws no air before a scene.";
  if (has.skySlice && !asked.skySlice) return "The view draws from a slice alone.";
  return nullptr;
}

const char* shaftChange(const Plan& has, const Plan& asked) {
  if (!asked.shafts) return nullptr;
  if (!has.shafts) return "Light shafts are on now.";
  if (has.shaftMethod != asked.shaftMethod) return "Light shafts have another method.";
  return nullptr;
}

}  // namespace

inline namespace v1 {

PlanChange comparePlans(const Plan& current, const Plan& next) {
  PlanChange change;
  const char* tables = tableChange(current, next);
  const char* view = viewChange(current, next);
  const char* shafts = shaftChange(current, next);
  change.tables = tables != nullptr;
  const bool other =
      current.tableDesc.disabledEffects != next.tableDesc.disabledEffects ||
      current.tableDesc.solver != next.tableDesc.solver ||
      current.tableDesc.mie != next.tableDesc.mie ||
      plan::levelOf(current.tableDesc.quality) != plan::levelOf(next.tableDesc.quality);
  // A view is of tables of one kind, and shafts are of a view.
  change.shafts =
      shafts != nullptr || (next.shafts && (view != nullptr || (change.tables && other)));
  change.view = view != nullptr || change.shafts || (change.tables && other);
  Sentence why;
  if (tables != nullptr || view != nullptr || shafts != nullptr)
    why << (tables != nullptr ? tables : view != nullptr ? view : shafts);
  why.copyTo(change.reason, sizeof change.reason);
  return change;
}

bool planServes(const Plan& plan, const Needs& needs, char* reason, size_t reasonSize) {
  Sentence why;
  const bool serves = plan::checkNeeds(needs, &why) == Status::Ok &&
                      coversCamera(plan, needs, &why) && coversSun(plan, needs, &why) &&
                      coversScene(plan, needs, &why) && coversWishes(plan, needs, &why);
  why.copyTo(reason, reasonSize);
  return serves;
}

}  // namespace v1
}  // namespace alpenglow
