// Frames that are legal but most likely mistakes: a view reports each kind once.
#pragma once

#include "atmosphere/camera/picture.h"
#include "engine/device.h"

namespace alpenglow::view {

class Warnings {
 public:
  /// Of a frame that has been checked.
  void check(const engine::Device& device, const Parameters& parameters, const FrameState& state,
             VkFormat colorFormat);
  /// A frame begins: of hosts that never call advanceFrame. Once a context, not a view.
  static void checkAdvanced(engine::Device& device);
  /// For CasterSet, whose casters are seen while they are drawn.
  bool* outsideCasters() { return &outsideCasters_; }

 private:
  bool once(bool* reported, bool seen);

  bool deepCamera_ = false, darkSun_ = false, overflow_ = false, outsideCasters_ = false;
};

}  // namespace alpenglow::view
