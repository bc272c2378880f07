#include "baker.h"

#include <alpenglow/io/atmosphere_file.h>

#include <algorithm>

namespace alpenglow::view {
namespace {

constexpr double kFirstUnitsPerSecond = 1e8;
constexpr int kMostPieces = 24;  // In a frame.

// Whether tables of one description can be used where the other is wanted, but for the quality.
bool sameTables(const TableDesc& a, const TableDesc& b) {
  return a.solver == b.solver && a.orders == b.orders && a.disabledEffects == b.disabledEffects &&
         a.sunZenithFrom == b.sunZenithFrom && a.sunZenithTo == b.sunZenithTo &&
         a.sizes.stepCount == b.sizes.stepCount && a.mie == b.mie;
}

bool hasDraft(const TableDesc& desc) {
  return desc.solver == Solver::Moments && desc.quality != Quality::Draft;
}

TableDesc draftOf(TableDesc desc) {
  desc.quality = Quality::Draft;
  desc.sizes = {};
  return desc;
}

}  // namespace

bool Baker::wanted(const BakedAtmosphere& baked, bool alsoDraft) const {
  const TableDesc& desc = wish_.plan.tables;
  return sameTables(baked.desc, desc) && (alsoDraft || baked.desc.quality == desc.quality) &&
         io::firstDifference(baked.parameters, wish_.parameters).empty();
}

void Baker::start(bool draft) {
  BakedAtmosphere baked = {wish_.parameters, wish_.plan,
                           draft ? draftOf(wish_.plan.tables) : wish_.plan.tables, nullptr};
  Tables* made = nullptr;
  gpu_->check(createTables(context_, baked.parameters, baked.desc, &made));
  baked.tables = {made, [](Tables* tables) { destroyTables(tables); }};
  baking_ = std::move(baked);
  draft_ = draft;
  progress_ = {};
}

bool Baker::want(const Parameters& parameters, const Plan& plan) {
  const Wish before = std::exchange(wish_, {parameters, plan});
  if (baking_ && (draft_ || wanted(*baking_, false))) {
    // A draft of other tables keeps the plan that it was made by.
    if (sameTables(baking_->desc, plan.tables)) baking_->plan = plan;
    return false;
  }
  if (made_ && wanted(*made_, false)) {
    baking_.reset();
    made_->plan = plan;
    return true;
  }
  try {
    start(hasDraft(plan.tables));
  } catch (...) {
    wish_ = before;
    throw;
  }
  return false;
}

void Baker::again() {
  made_.reset();
  start(false);
}

void Baker::keep(const BakedAtmosphere& baked) {
  wish_ = {baked.parameters, baked.plan};
  baking_.reset();
  made_ = baked;
}

void Baker::learn(const Frame& frame, const PassTimer& timer) {
  const std::vector<double> seconds = timer.pieces("bake");
  auto& pieces = pieces_[frame.slot];
  for (size_t i = 0; i < std::min(seconds.size(), pieces.size()); ++i) {
    const auto& [kind, units] = pieces[i];
    const double rate = static_cast<double>(units) / std::max(seconds[i], 1e-6);
    const auto [known, isNew] = unitsPerSecond_.emplace(kind, rate);
    if (!isNew) known->second = 0.5 * (known->second + rate);
  }
  pieces.clear();
}

// A pass that was never timed may be as slow as the slowest.
double Baker::unitsPerSecond(const Kind& kind) const {
  const auto known = unitsPerSecond_.find(kind);
  if (known != unitsPerSecond_.end()) return known->second;
  double least = kFirstUnitsPerSecond;
  for (const auto& [other, rate] : unitsPerSecond_) least = std::min(least, rate);
  return least;
}

void Baker::record(const Frame& frame, PassTimer* timer, double seconds) {
  learn(frame, *timer);
  for (int i = 0; i < kMostPieces && seconds > 0.0; ++i) {
    if (!baking_ || progress_.done) return;
    // The slice belongs to the pass of the last call. If that is finished, or before the first
    // slice, the pass is unknown until the slice is recorded.
    const bool between = progress_.passFinished || progress_.pass == nullptr;
    const Kind before = {baking_->desc.quality, between ? "" : progress_.pass};
    const double budget = std::max(seconds * unitsPerSecond(before), 1.0);
    timer->time(frame, "bake", [&] {
      gpu_->check(recordBake(baking_->tables.get(), frame.commands, static_cast<uint64_t>(budget),
                             &progress_));
    });
    const Kind kind = {baking_->desc.quality, progress_.pass};
    pieces_[frame.slot].emplace_back(kind, progress_.unitsRecorded);
    seconds -= static_cast<double>(progress_.unitsRecorded) / unitsPerSecond(kind);
  }
}

std::optional<BakedAtmosphere> Baker::take() {
  if (!baking_ || !progress_.done) return std::nullopt;
  made_ = std::exchange(baking_, std::nullopt);
  if (!wanted(*made_, false)) {
    // The draft of what is wanted, or, where that has changed since, first a draft of it.
    try {
      start(!wanted(*made_, true) && hasDraft(wish_.plan.tables));
    } catch (const std::exception& reason) {
      refusal_ = reason.what();
    }
  }
  return made_;
}

}  // namespace alpenglow::view
