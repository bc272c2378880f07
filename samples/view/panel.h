// The panel: all that can be seen and turned, in Dear ImGui.
#pragma once

#include <memory>
#include <string>

#include "baker.h"
#include "controls.h"
#include "pass_timer.h"
#include "state.h"

namespace alpenglow::view {

/// What the panel shows and does not change.
struct PanelFacts {
  const BakedAtmosphere* baked = nullptr;  ///< Null before the first bake is done.
  const Baker* baker = nullptr;
  const PassTimer* timer = nullptr;
  const std::vector<Binding>* bindings = nullptr;
  ResourceReport resources;
  std::string device;
  double exposure = 1.0;
  float frame_ms = 0.0f, scale = 1.0f;
  VkExtent2D drawn = {};
  bool resting = false;  ///< Nothing moves, so nothing is drawn.
  std::string caption;   ///< Of a flythrough.
  std::string trouble;   ///< What can't be drawn or compiled, and why.
};

class TablePictures;

class Panel {
 public:
  /// All outlive it. Throws.
  Panel(const samples::Gpu* gpu, VkRenderPass renderPass);
  ~Panel();

  /// Between Interface::begin() and end().
  void make(State* state, const PanelFacts& facts);

 private:
  std::unique_ptr<TablePictures> tables_;
  float window_[2] = {};  ///< Size that the last frame had.
  std::string message_;   ///< That is shown, and since when.
  double messageSince_ = 0.0;
};

}  // namespace alpenglow::view
