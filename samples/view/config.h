// The viewer's config file: JSON with comments; samples/view/view.json is one with all there is.
#pragma once

#include <string>
#include <vector>

#include "controls.h"

namespace alpenglow::view {

struct Config {
  uint32_t width = 1280, height = 720;  ///< Of the window, in screen coordinates.
  bool vsync = true;
  bool panel = true;
  double interfaceScale = 1.0;    ///< Besides the monitor's.
  double framesPerSecond = 20.0;  ///< Below it, moving pictures are drawn with fewer pixels.
  double bakeSeconds = 0.006;     ///< Of a frame, that a bake takes.
  std::vector<Binding> bindings = defaultBindings();
};

/// Throws a Failure that names what is wrong and what was expected.
Config readConfig(const std::string& path);
/// $XDG_CONFIG_HOME/alpenglow/view.json or ~/.config/alpenglow/view.json, if there is such a file;
/// else "".
std::string usualConfig();

}  // namespace alpenglow::view
