// Plans of the public API: the rules of the plan's room, and what their outcome costs, told by
// really planning tables and views both ways.
#include <alpenglow/plan.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <string_view>

#include "atmosphere/bake/moment_shape.h"
#include "atmosphere/bake/plan.h"
#include "atmosphere/bake/table_set.h"
#include "atmosphere/model/solvers.h"
#include "atmosphere/models/model_plan.h"
#include "atmosphere/plan/rules.h"
#include "atmosphere/sky/parts.h"
#include "atmosphere/sky/view_cost.h"
#include "engine/exceptions.h"

namespace alpenglow {
namespace {

/// Of lavapipe on 2 cores: half of the 0.97 cpu-s that earth takes at medium (docs/accuracy.md),
/// over its 2.11e8 units.
constexpr double kSecondsPerUnit = 2.3e-9;
/// ShaftsDesc::sunMapSize as it is left; images of the picture's size are the host's to tell.
constexpr uint32_t kSunMapSize = 2048;

bake::SolverPlan tablePlan(const Parameters& parameters, const TableDesc& completed) {
  if (isModel(completed.solver))
    return models::modelPlan(parameters, completed, TableFormat::Float);
  return completed.solver == Solver::Moments
             ? bake::momentPlan(parameters, completed)
             : bake::standardPlan(parameters, completed, TableFormat::Float);
}

ViewDesc viewOf(const Plan& plan) {
  ViewDesc view;
  describeView(plan, &view);
  view.projection = plan.needs.projection;
  return view;
}

bool sliced(const Plan& plan) { return plan.skySlice && hasSkySlice(plan.tableDesc.solver); }

void add(PlanCost* to, const PlanCost& more) {
  uint64_t* sum = &to->bytes;
  const uint64_t* from = &more.bytes;
  static_assert(sizeof(PlanCost) % sizeof(uint64_t) == 0);
  for (size_t i = 0; i < sizeof(PlanCost) / sizeof(uint64_t); ++i) sum[i] += from[i];
}

PlanCost difference(const PlanCost& more, const PlanCost& less) {
  PlanCost result;
  uint64_t* out = &result.bytes;
  const uint64_t *a = &more.bytes, *b = &less.bytes;
  for (size_t i = 0; i < sizeof(PlanCost) / sizeof(uint64_t); ++i)
    out[i] = a[i] > b[i] ? a[i] - b[i] : 0;
  return result;
}

// The map from the sun; one draw of casters and the surface between light and shadow from tables
// and from an air volume, and the culling of its blocks.
PlanCost shaftCost(const Plan& plan) {
  PlanCost cost;
  if (!plan.shafts) return cost;
  cost.images = 1;
  cost.texels = uint64_t{kSunMapSize} * kSunMapSize;
  cost.bytes = cost.texels * 4;
  cost.pipelines = 3 + (plan.skySlice ? 1 : 0);
  cost.dispatches = 1;
  return cost;
}

PlanCost costOf(const Parameters& parameters, const Plan& plan) {
  PlanCost cost;
  const Parameters air = bake::simulated(parameters, plan.tableDesc.without);
  const TableDesc full = bake::completed(air, plan.tableDesc);
  cost = bake::costOf(tablePlan(air, full));
  add(&cost, sky::viewCost(full, viewOf(plan), sliced(plan), plan.sceneDepth));
  add(&cost, shaftCost(plan));
  return cost;
}

void listTables(const Parameters& parameters, Plan* plan) {
  plan->tableCount = 0;
  const Parameters air = bake::simulated(parameters, plan->tableDesc.without);
  const TableDesc full = bake::completed(air, plan->tableDesc);
  const bake::SolverPlan tables = tablePlan(air, full);
  for (const bake::PlanImage& image : tables.images) {
    if (!image.persistent) continue;
    const VkExtent3D& e = image.extent;
    plan->tables[plan->tableCount++] = {bake::shortName(image), e.width, e.height, e.depth,
                                        bake::bytesOf(image)};
  }
  PlanTable views[sky::kMaxViewTables];
  const uint32_t count =
      sky::viewTables(full, viewOf(*plan), sliced(*plan), plan->sceneDepth, views);
  for (uint32_t i = 0; i < count; ++i) plan->tables[plan->tableCount++] = views[i];
  if (plan->shafts) {
    plan->tables[plan->tableCount++] = {"sun map", kSunMapSize, kSunMapSize, 1,
                                        uint64_t{kSunMapSize} * kSunMapSize * 4};
  }
}

bool withinBudget(const Plan& plan) {
  const Needs& needs = plan.needs;
  const double unit = needs.secondsPerUnit > 0.0 ? needs.secondsPerUnit : kSecondsPerUnit;
  return (needs.budgetBytes == 0 || plan.cost.bytes <= needs.budgetBytes) &&
         (needs.budgetSeconds == 0.0 ||
          static_cast<double>(plan.cost.units) * unit <= needs.budgetSeconds);
}

// Lowers the level until everything fits; what the host gave is kept.
void fitBudget(const Parameters& parameters, const TableDesc& base, Plan* plan) {
  plan->cost = costOf(parameters, *plan);
  while (!withinBudget(*plan) && base.solver == Solver::Moments &&
         base.quality == Quality::Default && plan->tableDesc.quality > Quality::Draft) {
    const auto lower = static_cast<uint32_t>(plan::levelOf(plan->tableDesc.quality)) - 1;
    plan::setQuality(parameters, static_cast<Quality>(lower), plan);
    plan->cost = costOf(parameters, *plan);
  }
  plan->budgetMet = withinBudget(*plan);
}

PlanCost savedBy(const Parameters& parameters, const TableDesc& base, const Plan& plan,
                 Effect effect) {
  Plan other = plan;
  other.effects[static_cast<uint32_t>(effect)].on = true;
  // Shafts are of the air before a scene.
  if (effect == Effect::LightShafts)
    other.effects[static_cast<uint32_t>(Effect::AerialPerspective)].on = true;
  plan::applyEffects(parameters, base, &other);
  return difference(costOf(parameters, other), plan.cost);
}

// Against the default of each choice.
void priceChoices(const Parameters& parameters, Plan* plan) {
  for (uint32_t i = 0; i < plan->choiceCount; ++i) {
    PlanChoice& choice = plan->choices[i];
    Plan other = *plan;
    const std::string_view name = choice.name;
    if (name == "sun_zenith") {
      other.tableDesc.sunZenithFrom = other.tableDesc.sunZenithTo = 0.0;
    } else if (name == "optical_depths") {
      other.tableDesc.moments.depthMu = other.tableDesc.moments.depthH = 0;
    } else if (name == "quality") {
      other.tableDesc.quality = Quality::Medium;
    } else {
      continue;
    }
    choice.saves = difference(costOf(parameters, other), plan->cost);
  }
}

PlanCost wholeCost(const Parameters& parameters, const Plan& plan) {
  Plan whole;
  whole.tableDesc.solver = plan.tableDesc.solver;
  whole.needs.projection = plan.needs.projection;
  for (EffectChoice& choice : whole.effects) choice.on = true;
  plan::applyEffects(parameters, whole.tableDesc, &whole);
  return costOf(parameters, whole);
}

void fill(const Parameters& parameters, const Needs& needs, const TableDesc& base, Plan* plan) {
  plan->needs = needs;
  plan->tableDesc = base;
  plan::decideEffects(parameters, base, plan);
  plan::applyEffects(parameters, base, plan);
  plan::decideQuality(parameters, base, plan);
  const Quality unbound = plan->tableDesc.quality;
  fitBudget(parameters, base, plan);
  plan::fitDepths(base, plan);
  plan->cost = costOf(parameters, *plan);
  plan->budgetMet = withinBudget(*plan);
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    EffectChoice& choice = plan->effects[i];
    if (!choice.on) choice.saves = savedBy(parameters, base, *plan, static_cast<Effect>(i));
  }
  const uint32_t solved = base.solver == Solver::Moments ? bake::solvedOrders(parameters, base) : 5;
  plan::describeChoices(parameters, base, solved, unbound, plan);
  priceChoices(parameters, plan);
  listTables(parameters, plan);
  plan->whole = wholeCost(parameters, *plan);
}

}  // namespace

inline namespace v1 {

Status makePlan(const Parameters& parameters, const Needs& needs, const TableDesc& base, Plan* out,
                char* message, size_t messageSize) {
  ALPENGLOW_TRY {
    if (out == nullptr) return Status::InvalidArgument;
    Status status = validate(parameters, message, messageSize);
    if (status != Status::Ok) return status;
    model::Sentence why;
    status = plan::checkNeeds(needs, &why);
    if (status == Status::Ok) status = plan::checkBase(needs, base, &why);
    why.copyTo(message, messageSize);
    if (status != Status::Ok) return status;
    Plan made;
    fill(parameters, needs, base, &made);
    *out = made;
    return Status::Ok;
  }
  ALPENGLOW_CATCH_BAD_ALLOC {  // No exception may reach the host.
    return Status::OutOfHostMemory;
  }
}

void describeView(const Plan& plan, ViewDesc* view) {
  view->solver = plan.tableDesc.solver;
  view->mie = plan.tableDesc.mie;
  view->without = plan.viewWithout;
  view->alwaysSliced = plan.skySlice;
}

SeenFlags seenBy(const Parameters& parameters, Projection projection, const SkyDraw& draw) {
  ViewDesc view;
  view.projection = projection;
  SeenFlags seen = 0;
  const sky::Parts parts = sky::cut(parameters, view, draw);
  for (uint32_t i = 0; i < parts.count; ++i) {
    const sky::Visible& v = parts.parts[i].visible;
    if (v.air) seen |= kSeenSky;
    if (v.ground) seen |= kSeenGround;
    if (!v.air) seen |= kSeenSpace;
    if (v.disc) seen |= kSeenSun;
  }
  return seen;
}

}  // namespace v1
}  // namespace alpenglow
