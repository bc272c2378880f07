#include "window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

#include "common/failure.h"

namespace alpenglow::view {
namespace {

using samples::Failure;

std::string glfwReason() {
  const char* reason = nullptr;
  glfwGetError(&reason);
  return reason != nullptr ? reason : "no reason given";
}

}  // namespace

Window::Window(uint32_t width, uint32_t height, const std::string& title) {
  if (glfwInit() == GLFW_FALSE) {
    throw Failure("No window can be opened (" + glfwReason() +
                  "): alpenglow-view needs a display; xvfb-run makes one without a monitor.");
  }
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  window_ = glfwCreateWindow(static_cast<int>(width), static_cast<int>(height), title.c_str(),
                             nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string reason = glfwReason();
    glfwTerminate();
    throw Failure("A window of " + std::to_string(width) + "x" + std::to_string(height) +
                  " can't be opened: " + reason + ".");
  }
  glfwSetWindowUserPointer(window_, this);
}

Window::~Window() {
  glfwDestroyWindow(window_);
  glfwTerminate();
}

std::vector<std::string> Window::instanceExtensions() {
  uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (names == nullptr) throw Failure("No Vulkan window can be opened: " + glfwReason() + ".");
  return {names, names + count};
}

VkSurfaceKHR Window::createSurface(VkInstance instance) const {
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  if (glfwCreateWindowSurface(instance, window_, nullptr, &surface) < 0) {
    throw Failure("Vulkan can't draw into the window: " + glfwReason() + ".");
  }
  return surface;
}

VkExtent2D Window::size() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_TRUE) width = height = 0;
  return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

float Window::scale() const {
  float x = 1.0f, y = 1.0f;
  glfwGetWindowContentScale(window_, &x, &y);
  return std::max(x, y);
}

bool Window::focused() const { return glfwGetWindowAttrib(window_, GLFW_FOCUSED) == GLFW_TRUE; }

void Window::listenToKeys() {
  glfwSetKeyCallback(window_,
                     [](GLFWwindow* window, int key, int scancode, int action, int modifiers) {
                       auto* self = static_cast<Window*>(glfwGetWindowUserPointer(window));
                       self->keys.push_back({key, scancode, action, modifiers});
                     });
}

void Window::poll(double seconds) {
  keys.clear();
  if (seconds > 0.0) {
    glfwWaitEventsTimeout(seconds);
  } else {
    glfwPollEvents();
  }
}

bool Window::held(int key) const { return glfwGetKey(window_, key) == GLFW_PRESS; }

void Window::drag(bool allowed, double moved[2]) {
  double x = 0.0, y = 0.0;
  glfwGetCursorPos(window_, &x, &y);
  const bool pressed = glfwGetMouseButton(window_, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS;
  const bool goesOn = pressed && (dragging_ || allowed);
  moved[0] = goesOn && dragging_ ? x - pointer_[0] : 0.0;
  moved[1] = goesOn && dragging_ ? y - pointer_[1] : 0.0;
  if (goesOn != dragging_) {
    glfwSetInputMode(window_, GLFW_CURSOR, goesOn ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
    glfwGetCursorPos(window_, &x, &y);  // Hiding the pointer moves it.
  }
  dragging_ = goesOn;
  pointer_[0] = x;
  pointer_[1] = y;
}

}  // namespace alpenglow::view
