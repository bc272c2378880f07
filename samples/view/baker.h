// Tables that follow what is wanted: baked in slices while the old ones draw.
#pragma once

#include <alpenglow/plan.h>

#include <memory>
#include <optional>

#include "terrain/gpu.h"

namespace alpenglow::view {

/// What is to be simulated, and its tables.
struct Air {
  Parameters parameters;
  Plan plan;
  TableDesc desc;  ///< As the plan's; of draft quality while a change is under way.
  std::shared_ptr<Tables> tables;
};

class Baker {
 public:
  /// Both outlive it and every Air of it.
  Baker(const samples::Gpu* gpu, Context* context) : gpu_(gpu), context_(context) {}

  /// Starts what is missing. A change cancels a bake, but for drafts, which take a few frames:
  /// while a slider is being moved each of them is seen, and the full quality follows when it
  /// rests. Returns whether the last Air has all of it already. Throws for what the library
  /// refuses; then all is as it was.
  bool want(const Parameters& parameters, const Plan& plan);

  /// Bakes what is wanted anew: shaders have changed. Throws as want().
  void again();

  /// Records slices of about `units` table fetches in all.
  void record(VkCommandBuffer commands, uint64_t units);

  /// Once, when a bake is done: what it made. The next one starts.
  std::optional<Air> take();

  /// All that is wanted was made.
  bool idle() const { return !baking_; }
  /// Of the bake under way.
  const BakeProgress& progress() const { return progress_; }
  uint64_t unitsRecorded() const { return unitsRecorded_; }  ///< By the last record().

 private:
  struct Wish {
    Parameters parameters;
    Plan plan;
  };
  bool wanted(const Air& air, bool alsoDraft) const;
  void start(bool draft);

  const samples::Gpu* gpu_;
  Context* context_;
  Wish wish_;
  std::optional<Air> baking_, made_;
  bool draft_ = false;  ///< What is being baked is one.
  BakeProgress progress_;
  uint64_t unitsRecorded_ = 0;
};

}  // namespace alpenglow::view
