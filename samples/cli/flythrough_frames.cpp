#include "flythrough_frames.h"

#include <alpenglow/io/atmosphere_file.h>

#include <algorithm>

#include "common/compare.h"
#include "common/scene_plan.h"

namespace alpenglow::cli {
namespace {

// Options and solver are the same for all of a flythrough, so that only these follow the
// atmosphere.
bool sameShape(const TableDesc& a, const TableDesc& b) { return samples::same(a.sizes, b.sizes); }

}  // namespace

FlythroughFrames::FlythroughFrames(FlythroughParts parts, const io::Scene& first,
                                   TableRequest request)
    : parts_(std::move(parts)),
      target_(createPictureTarget(parts_.session, first.width, first.height)),
      request_(std::move(request)),
      air_(first.atmosphere) {}

void FlythroughFrames::useTables(const io::Scene& scene) {
  const bool changed = !io::firstDifference(air_, scene.atmosphere).empty();
  if (ready_ && !changed) return;
  if (changed) {
    air_ = scene.atmosphere;
    request_ = requestTables(*parts_.tables, air_, &scene);
  }
  if (ready_ && !sameShape(ready_->desc, request_.desc)) painter_.reset();
  ready_.reset();  // Before there are others: they may be large.
  ready_ = obtainTables(parts_.session, air_, std::move(request_));
}

void FlythroughFrames::usePainter(const io::Scene& scene) {
  const Projection projection = samples::projectionOf(scene.camera);
  if (projection_ == projection && painter_) return;
  painter_.reset();
  const Plan plan = planOf(scene);
  if ((scene.terrain || !scene.balloons.empty()) && projection_ != projection) {
    scenery_.reset();
    scenery_.emplace(parts_.session, scene, *parts_.files, *ready_, parts_.shafts, plan);
  }
  projection_ = projection;
  painter_.emplace(parts_.session, parts_.albedo, *ready_, plan, scenery_ ? &*scenery_ : nullptr);
}

// Of a camera and a sun that may go anywhere, with tables as they are.
Plan FlythroughFrames::planOf(const io::Scene& scene) const {
  PlanRequest request = samples::requestOfFlight(scene);
  request.casters = parts_.shafts.method != LightShaftMethod::Off;
  for (uint32_t i = 0; i < kEffectCount; ++i)
    if ((kTableEffects & (1u << i)) != 0) request.effects[i] = Force::On;
  request.tables = ready_->desc;
  return samples::planRequest(scene, request);
}

io::LinearImage FlythroughFrames::draw(const io::Scene& scene) {
  useTables(scene);
  usePainter(scene);
  return painter_->draw(scene, ready_->tables.get(), target_);
}

}  // namespace alpenglow::cli
