// The viewer's window: GLFW's, with what happened in it since the last look.
#pragma once

#include <vulkan/vulkan_core.h>

#include <string>
#include <vector>

struct GLFWwindow;

namespace alpenglow::view {

/// As GLFW's key callback has it.
struct KeyEvent {
  int key = 0, scancode = 0, action = 0, modifiers = 0;
};

class Window {
 public:
  /// In screen coordinates. Throws a Failure where there is no display.
  Window(uint32_t width, uint32_t height, const std::string& title);
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  ~Window();

  GLFWwindow* handle() const { return window_; }
  static std::vector<std::string> instanceExtensions();
  VkSurfaceKHR createSurface(VkInstance instance) const;

  /// In pixels; 0 x 0 while minimised.
  VkExtent2D size() const;
  /// Of the monitor that the window is on: 1 for 96 dots an inch.
  float scale() const;
  bool focused() const;

  /// From now on `keys` are collected, and no other callback of the window hears of them.
  void listenToKeys();
  /// Looks at events, or waits for them up to `seconds`. What keys did since the last call is in
  /// `keys`.
  void poll(double seconds);
  std::vector<KeyEvent> keys;
  bool held(int key) const;
  /// Pixels that the mouse was dragged by, with the button that turns the camera, since the last
  /// call; keeps the pointer hidden meanwhile.
  void drag(bool allowed, double moved[2]);

 private:
  GLFWwindow* window_ = nullptr;
  bool dragging_ = false;
  double pointer_[2] = {};
};

}  // namespace alpenglow::view
