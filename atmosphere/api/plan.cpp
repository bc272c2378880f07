// Plans of the public API: the rules of atmosphere/plan, and the cost of their outcome, from the
// graphs and views of both variants.
#include <alpenglow/plan.h>

#include <new>
#include <string_view>

#include "atmosphere/api/solver_plan.h"
#include "atmosphere/camera/viewport_partition.h"
#include "atmosphere/parameters/solvers.h"
#include "atmosphere/passes/sky_pass.h"
#include "atmosphere/passes/view_cost.h"
#include "atmosphere/plan/rules.h"
#include "atmosphere/tables/moment_shape.h"
#include "atmosphere/tables/table_set.h"
#include "atmosphere/view/frame.h"
#include "atmosphere/view/view_desc.h"
#include "engine/exceptions.h"

namespace alpenglow {
namespace {

using plan::add;
using plan::choiceOf;
using plan::difference;

/// A plan's tables with all zeros of its description resolved.
struct Completed {
  Parameters parameters;
  TableDesc desc;
};
Completed completedTables(const Parameters& parameters, const Plan& plan) {
  const Parameters medium = tables::simulated(parameters, plan.tables.disabledEffects);
  return {medium, tables::completed(medium, plan.tables)};
}

tables::BakeGraph solverPlanOf(const Completed& tables) {
  return solverPlan(tables.parameters, tables.desc, TableFormat::Float);
}

PlanCost tableCost(const tables::BakeGraph& plan) {
  const tables::TableCost c = tables::costOf(plan);
  return {c.bytes, c.bakeBytes, c.texels, c.images, c.pipelines, c.dispatches, c.units};
}

PlanCost costOf(const Parameters& parameters, const Plan& plan) {
  const Completed tables = completedTables(parameters, plan);
  PlanCost cost = tableCost(solverPlanOf(tables));
  add(&cost, passes::viewCost(tables.desc, view::resolve(tables.desc, plan.view).picture));
  add(&cost, plan::lightShaftCost(plan));
  return cost;
}

void listImages(const Parameters& parameters, Plan* plan) {
  plan->imageCount = 0;
  const auto append = [plan](const ImageInfo& image) { plan->images[plan->imageCount++] = image; };
  const Completed tables = completedTables(parameters, *plan);
  const tables::BakeGraph solver = solverPlanOf(tables);
  for (const tables::BakeImage& image : solver.images) {
    if (!image.persistent) continue;
    ImageInfo info;
    info.name = tables::shortName(image);
    info.extent = image.extent;
    info.bytes = tables::bytesOf(image);
    append(info);
  }
  ImageInfo views[passes::kMaxViewImages];
  const uint32_t count =
      passes::viewImages(tables.desc, view::resolve(tables.desc, plan->view).picture, views);
  for (uint32_t i = 0; i < count; ++i) append(views[i]);
  if (plan::drawsLightShafts(*plan)) append(plan::shadowMapImage());
}

// Lowers the level until the budget is met; values given by the host are kept.
void fitBudget(const Parameters& parameters, Plan* plan) {
  const TableDesc& base = plan->request.tables;
  plan::setCost(costOf(parameters, *plan), plan);
  while (!plan->budgetMet && base.solver == Solver::Moments && base.quality == Quality::Default &&
         plan->tables.quality > Quality::Draft) {
    const auto lower = static_cast<uint32_t>(plan::levelOf(plan->tables.quality)) - 1;
    plan::setQuality(parameters, static_cast<Quality>(lower), plan);
    plan::setCost(costOf(parameters, *plan), plan);
  }
}

PlanCost savedBy(const Parameters& parameters, const Plan& plan, Effect effect) {
  Plan other = plan;
  choiceOf(&other, effect).on = true;
  // Light shafts need aerial perspective over a scene.
  if (effect == Effect::LightShafts) choiceOf(&other, Effect::AerialPerspective).on = true;
  plan::applyEffects(parameters, &other);
  return difference(costOf(parameters, other), plan.cost);
}

// Costs relative to the default of each choice.
void priceChoices(const Parameters& parameters, Plan* plan) {
  for (uint32_t i = kEffectCount; i < plan->choiceCount; ++i) {
    PlanChoice& choice = plan->choices[i];
    Plan other = *plan;
    const std::string_view name = choice.name;
    if (name == "sun_zenith") {
      other.tables.sunZenithFrom = other.tables.sunZenithTo = 0.0;
    } else if (name == "optical_depths") {
      other.tables.sizes.depthMu = other.tables.sizes.depthH = 0;
    } else if (name == "quality") {
      other.tables.quality = Quality::Medium;
    } else {
      continue;
    }
    choice.saves = difference(costOf(parameters, other), plan->cost);
  }
}

PlanCost wholeCost(const Parameters& parameters, const Plan& plan) {
  Plan whole;
  whole.tables.solver = whole.request.tables.solver = plan.tables.solver;
  whole.view.projection = whole.request.view.projection = plan.request.view.projection;
  for (uint32_t i = 0; i < kEffectCount; ++i) whole.choices[i].on = true;
  plan::applyEffects(parameters, &whole);
  return costOf(parameters, whole);
}

void fill(const Parameters& parameters, const PlanRequest& request, Plan* plan) {
  plan->request = request;
  plan->tables = request.tables;
  plan->view = request.view;
  plan::decideEffects(parameters, plan);
  plan::applyEffects(parameters, plan);
  plan::decideQuality(parameters, plan);
  const Quality unbound = plan->tables.quality;
  fitBudget(parameters, plan);
  plan::fitDepths(plan);
  plan::setCost(costOf(parameters, *plan), plan);
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    PlanChoice& choice = plan->choices[i];
    if (!choice.on) choice.saves = savedBy(parameters, *plan, static_cast<Effect>(i));
  }
  const TableDesc& base = request.tables;
  const uint32_t solved =
      base.solver == Solver::Moments ? tables::solvedOrders(parameters, base) : 5;
  plan::describeChoices(parameters, solved, unbound, plan);
  priceChoices(parameters, plan);
  listImages(parameters, plan);
  plan->whole = wholeCost(parameters, *plan);
}

/// Checks them like createTables, on a device with the largest images that any has.
Status checkTables(const Parameters& parameters, const PlanRequest& request,
                   const DiagnosticSink& sink) {
  TableDesc desc = request.tables;
  return resolveTableDesc(parameters, &desc, sink);
}

}  // namespace

inline namespace v1_0 {

Status makePlan(const Parameters& parameters, const PlanRequest& request, Plan* out,
                const DiagnosticSink& sink) {
  ALPENGLOW_TRY {
    if (out == nullptr) return parameters::reportNull(sink, "makePlan", "the plan");
    Status status = validate(parameters, sink);
    if (status != Status::Ok) return status;
    parameters::Sentence why;
    status = plan::checkRequest(request, &why);
    if (status != Status::Ok) return parameters::report(sink, status, why);
    status = checkTables(parameters, request, sink);
    if (status != Status::Ok) return status;
    status = plan::checkTables(request, &why);
    if (status != Status::Ok) return parameters::report(sink, status, why);
    Plan made;
    fill(parameters, request, &made);
    *out = made;
    return Status::Ok;
  }
  ALPENGLOW_CATCH_BAD_ALLOC {  // No exception may reach the host.
    return parameters::report(sink, Status::OutOfHostMemory, "There is no host memory for a plan.");
  }
}

VisibilityFlags visibleFrom(const Parameters& parameters, Projection projection,
                            const FrameDesc& frame) {
  constexpr VisibilityFlags kAnything = kVisibleSky | kVisibleGround | kVisibleSpace | kVisibleSun;
  PictureDesc picture;
  picture.projection = projection;
  const FrameState state =
      view::frameState(frame, projection, parameters.solarIrradiance, frame.sceneDepth.extent);
  if (!passes::drawable(projection, state)) return kAnything;
  VisibilityFlags visible = 0;
  const passes::ViewportPartition parts = passes::cut(parameters, picture, state);
  for (uint32_t i = 0; i < parts.count; ++i) {
    const passes::Visible& v = parts.parts[i].visible;
    if (v.atmosphere) visible |= kVisibleSky;
    if (v.ground) visible |= kVisibleGround;
    if (!v.atmosphere) visible |= kVisibleSpace;
    if (v.disc) visible |= kVisibleSun;
  }
  return visible;
}

}  // namespace v1_0
}  // namespace alpenglow
