// Dear ImGui on the viewer's window and device.
#pragma once

#include "presenter.h"

namespace alpenglow::view {

class Interface {
 public:
  /// All outlive it. Throws.
  Interface(const samples::Gpu* gpu, Window* window, const Presenter* presenter, double scale);
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;
  ~Interface();

  /// Between the two, the panel is made. Text follows the scale of the window's monitor.
  void begin();
  static void end();
  /// Inside the window's pass.
  static void record(VkCommandBuffer commands);

  /// While text is typed, or a list is open.
  static bool wantsKeyboard();
  static bool wantsMouse();
  /// The command buffer that record() is at, for callbacks of draw lists.
  static VkCommandBuffer recording();

 private:
  /// Glyphs are rebuilt for a scale, so that text is sharp; so is what draws them.
  void setScale(float scale);
  void startDrawing();
  void handOnKeys();

  const samples::Gpu* gpu_;
  Window* window_;
  const Presenter* presenter_;
  float ownScale_ = 1.0f, scale_ = 0.0f;
  samples::Owned<VkDescriptorPool> pool_;
  std::vector<KeyEvent> held_;  ///< Releases that the next frame hears of.
};

}  // namespace alpenglow::view
