// --script FILE: what a user would do, a line for each step, for tests and for pictures in docs. A
// step that can't be done ends the program with a sentence and its line.
//
//   frames N             let N frames pass
//   seconds S            let S seconds pass
//   settle               until the bakes are done and the picture rests at full resolution
//   press KEY [shift]    a key by its name in config files
//   fly F R U N          hold forward, right, up (-1 to 1) for N frames
//   drag X Y             the mouse, pixels
//   resize W H           the window
//   set NAME VALUE       a parameter, such as mie.asymmetry, sun.elevation_deg or turbidity
//   choose NAME VALUE    a choice, such as solver standard or effects.mie off
//   exposure VALUE|auto
//   seek SECONDS         a flythrough, which then halts
//   random N SEED        change a random parameter in each of N frames
//   show SECTION...      open these sections of the panel, such as Atmosphere, and close the others
//   save FILE            .png or .exr, as the keys do
//   report FILE          JSON: the scene, times of the frames since the last report, memory
//   quit
#pragma once

#include <chrono>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "config.h"

namespace alpenglow::view {

/// What a script needs of the program beyond its state.
struct ScriptHost {
  std::function<bool()> settled;
  std::function<void(uint32_t width, uint32_t height)> resize;
  std::function<bool(double seconds)> seek;  ///< False without a flythrough.
  std::function<void(const std::string& path)> report;
};

class Script {
 public:
  /// Reads and checks it all. Throws a Failure.
  Script(const std::string& path, const std::vector<Binding>& bindings);

  /// Before each frame: does steps until one takes a frame. Throws a Failure.
  void step(State* state, const ScriptHost& host);
  bool finished() const { return next_ >= steps_.size() && frames_ == 0; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Step {
    int line = 0;
    std::vector<std::string> words;
    double number(size_t i) const { return std::stod(words[i]); }
  };
  [[noreturn]] void refuse(const Step& step, const std::string& why) const;
  void check(const Step& step) const;
  /// Whether the frame may begin.
  bool run(const Step& step, State* state, const ScriptHost& host);
  void change(const Step& step, State* state) const;
  void changeRandomly(State* state);

  std::string path_;
  const std::vector<Binding>& bindings_;
  std::vector<Step> steps_;
  size_t next_ = 0;
  uint32_t frames_ = 0;      ///< Of the current step, that are left.
  Clock::time_point until_;  ///< No step is done before.
  uint32_t waited_ = 0;      ///< For the scene to settle.
  std::mt19937 random_;
};

}  // namespace alpenglow::view
