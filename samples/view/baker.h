// Tables that follow what is wanted: baked in slices while the old ones draw.
#pragma once

#include <alpenglow/plan.h>

#include <memory>
#include <optional>

#include "pass_timer.h"

namespace alpenglow::view {

/// What is to be simulated, and its tables.
struct BakedAtmosphere {
  Parameters parameters;
  Plan plan;
  TableDesc desc;  ///< As the plan's; of draft quality while a change is under way.
  std::shared_ptr<Tables> tables;
};

class Baker {
 public:
  /// Both outlive it and every BakedAtmosphere of it.
  Baker(const samples::Gpu* gpu, Context* context) : gpu_(gpu), context_(context) {}

  /// Starts what is missing. A change cancels a bake, but for drafts, which take a few frames:
  /// while a slider is being moved each of them is seen, and the full quality follows when it
  /// rests. Returns whether the last BakedAtmosphere has all of it already. Throws for what the
  /// library refuses; then all is as it was.
  bool want(const Parameters& parameters, const Plan& plan);

  /// Bakes what is wanted again: shaders have changed. Throws as want().
  void again();
  /// Wants what this one is, or would be in full, and nothing else.
  void keep(const BakedAtmosphere& baked);

  /// Records slices that take about `seconds` in all, by what such slices took before; timed as
  /// "bake".
  void record(const Frame& frame, PassTimer* timer, double seconds);

  /// Once, when a bake is done: what it made. The next one starts; where it can't, takeRefusal()
  /// has the sentence, once.
  std::optional<BakedAtmosphere> take();
  std::string takeRefusal() { return std::exchange(refusal_, ""); }

  /// All that is wanted was made.
  bool idle() const { return !baking_; }
  /// What is being baked is of draft quality, until the wanted one is ready.
  bool draft() const { return draft_; }
  /// Of the bake under way.
  const BakeProgress& progress() const { return progress_; }

 private:
  struct Wish {
    Parameters parameters;
    Plan plan;
  };
  bool wanted(const BakedAtmosphere& baked, bool alsoDraft) const;
  void start(bool draft);
  /// Work that a pass does in a second: passes differ by a factor of ten.
  using Kind = std::pair<Quality, std::string>;
  void learn(const Frame& frame, const PassTimer& timer);
  double unitsPerSecond(const Kind& kind) const;

  const samples::Gpu* gpu_;
  Context* context_;
  Wish wish_;
  std::optional<BakedAtmosphere> baking_, made_;
  bool draft_ = false;  ///< What is being baked is one.
  BakeProgress progress_;
  std::string refusal_;
  std::map<Kind, double> unitsPerSecond_;
  /// Recorded into each slot's last frame.
  std::array<std::vector<std::pair<Kind, uint64_t>>, kFramesInFlight> pieces_;
};

}  // namespace alpenglow::view
