#include "baker.h"

#include <alpenglow/io/atmosphere_file.h>

namespace alpenglow::view {
namespace {

// Whether tables of one description serve where the other is wanted, but for the quality.
bool sameTables(const TableDesc& a, const TableDesc& b) {
  return a.solver == b.solver && a.orders == b.orders && a.without == b.without &&
         a.sunZenithFrom == b.sunZenithFrom && a.sunZenithTo == b.sunZenithTo &&
         a.samples == b.samples;
}

bool hasDraft(const TableDesc& desc) {
  return desc.solver == Solver::Moments && desc.quality != Quality::Draft;
}

TableDesc draftOf(TableDesc desc) {
  desc.quality = Quality::Draft;
  desc.moments = {};
  return desc;
}

}  // namespace

bool Baker::wanted(const Air& air, bool alsoDraft) const {
  const TableDesc& desc = wish_.plan.tableDesc;
  return sameTables(air.desc, desc) && (alsoDraft || air.desc.quality == desc.quality) &&
         io::firstDifference(air.parameters, wish_.parameters).empty();
}

void Baker::start(bool draft) {
  Air air = {wish_.parameters, wish_.plan,
             draft ? draftOf(wish_.plan.tableDesc) : wish_.plan.tableDesc, nullptr};
  Tables* made = nullptr;
  gpu_->check(createTables(context_, air.parameters, air.desc, &made));
  const samples::Gpu* gpu = gpu_;
  air.tables = {made, [gpu](Tables* tables) { destroyTables(tables, gpu->frame()); }};
  baking_ = std::move(air);
  draft_ = draft;
  progress_ = {};
}

bool Baker::want(const Parameters& parameters, const Plan& plan) {
  const Wish before = std::exchange(wish_, {parameters, plan});
  try {
    if (baking_ && (draft_ || wanted(*baking_, false))) {
      baking_->plan = plan;
      return false;
    }
    baking_.reset();
    if (made_ && wanted(*made_, false)) {
      made_->plan = plan;
      return true;
    }
    start(hasDraft(plan.tableDesc));
  } catch (...) {
    wish_ = before;
    throw;
  }
  return false;
}

void Baker::again() {
  baking_.reset();
  start(false);
}

void Baker::record(VkCommandBuffer commands, uint64_t units) {
  unitsRecorded_ = 0;
  while (baking_ && !progress_.done && unitsRecorded_ < units) {
    gpu_->check(recordBake(baking_->tables.get(), commands, gpu_->frame(), units - unitsRecorded_,
                           &progress_));
    unitsRecorded_ += progress_.unitsRecorded;
  }
}

std::optional<Air> Baker::take() {
  if (!baking_ || !progress_.done) return std::nullopt;
  made_ = std::exchange(baking_, std::nullopt);
  if (!wanted(*made_, false)) {
    // The draft of what is wanted, or, where that has changed since, first a draft of it.
    start(!wanted(*made_, true) && hasDraft(wish_.plan.tableDesc));
  }
  return made_;
}

}  // namespace alpenglow::view
