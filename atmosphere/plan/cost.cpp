// Sums of costs, and what follows from them: the part that needs no other folder.
#include <iterator>

#include "atmosphere/plan/rules.h"

namespace alpenglow::plan {
namespace {

/// Of lavapipe on 2 cores: half of the 0.97 cpu-s that earth takes at medium (docs/accuracy.md),
/// over its 2.11e8 units.
constexpr double kSecondsPerUnit = 2.3e-9;

constexpr uint64_t PlanCost::*kCosts[] = {
    &PlanCost::bytes,     &PlanCost::bakeBytes,  &PlanCost::texels, &PlanCost::images,
    &PlanCost::pipelines, &PlanCost::dispatches, &PlanCost::units};
static_assert(sizeof(PlanCost) == std::size(kCosts) * sizeof(uint64_t));

}  // namespace

void add(PlanCost* to, const PlanCost& more) {
  for (const auto cost : kCosts) to->*cost += more.*cost;
}

PlanCost difference(const PlanCost& more, const PlanCost& less) {
  PlanCost result;
  for (const auto cost : kCosts)
    result.*cost = more.*cost > less.*cost ? more.*cost - less.*cost : 0;
  return result;
}

ImageInfo shadowMapImage() {
  ImageInfo info;
  info.name = "shadow map";
  info.extent = {kShadowMapSize, kShadowMapSize, 1};
  info.bytes = uint64_t{kShadowMapSize} * kShadowMapSize * 4;
  return info;
}

PlanCost lightShaftCost(const Plan& plan) {
  PlanCost cost;
  if (!drawsLightShafts(plan)) return cost;
  cost.images = 1;
  cost.texels = uint64_t{kShadowMapSize} * kShadowMapSize;
  cost.bytes = shadowMapImage().bytes;
  cost.pipelines = 3 + (drawsFromLut(plan) ? 1 : 0);
  cost.dispatches = 1;
  return cost;
}

double bakeSeconds(const PlanRequest& request, const PlanCost& cost) {
  const double unit = request.secondsPerUnit > 0.0 ? request.secondsPerUnit : kSecondsPerUnit;
  return static_cast<double>(cost.units) * unit;
}

void setCost(const PlanCost& cost, Plan* plan) {
  const PlanRequest& request = plan->request;
  plan->cost = cost;
  plan->expectedBakeSeconds = bakeSeconds(request, cost);
  plan->budgetMet =
      (request.budgetBytes == 0 || cost.bytes <= request.budgetBytes) &&
      (request.budgetSeconds == 0.0 || plan->expectedBakeSeconds <= request.budgetSeconds);
}

}  // namespace alpenglow::plan
