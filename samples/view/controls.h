// Keys and mouse: what each does to the scene.
#pragma once

#include <string>
#include <vector>

#include "state.h"
#include "window.h"

namespace alpenglow::view {

enum class Action : uint32_t {
  Forward,
  Back,
  Left,
  Right,
  Up,
  Down,
  Fast,  // while held
  SunUp,
  SunDown,
  SunLeft,
  SunRight,
  RayleighLess,
  RayleighMore,
  MieLess,
  MieMore,
  AsymmetryLess,
  AsymmetryMore,
  TurbidityLess,
  TurbidityMore,
  Help,
  Panel,
  Screenshot,
  Play,
  Reset,
  Quit,
};

/// A key that does something. Config files name the action; people read what it does.
struct Binding {
  Action action;
  const char* name;
  const char* what;
  int key;  ///< As GLFW numbers it.
};

/// As they are without a config file.
std::vector<Binding> defaultBindings();
/// "W", "Left", "F1", ...; 0 and "" where there is no such key.
int keyNamed(const std::string& name);
std::string keyName(int key);

/// Does what one press asks for. `shift` as it is held with it.
void press(State* state, Action action, bool shift);
/// What is held: moves the camera for `seconds`. `amounts` are forward, right and up, -1 to 1.
void fly(io::Scene* scene, const double amounts[3], bool fast, double seconds);
/// Turns the camera by pixels of the mouse, in a picture of this height.
void turn(io::Scene* scene, const double pixels[2], double pictureHeight);

/// All of it, for the window's input since the last frame.
void control(State* state, Window* window, const std::vector<Binding>& bindings, double seconds,
             bool keyboardFree, bool mouseFree);

}  // namespace alpenglow::view
