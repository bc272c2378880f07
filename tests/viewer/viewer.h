// Runs the built viewer on a display of its own.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../cli/program.h"

namespace alpenglow::test {

/// A display without a monitor, of 1280x1024 pixels, as long as it lives.
class Display {
 public:
  Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;
  ~Display();
  /// Such as ":7".
  const std::string& name() const { return name_; }

 private:
  int process_ = -1;
  std::string name_;
};

/// A folder, a display, and scenes and scripts in the folder.
class Viewer : public testing::Test {
 protected:
  Viewer();

  /// Runs a script, which need not quit, over a scene of draft quality in a window of 160x96
  /// pixels. The program must end well, without a validation message or a word on stderr.
  void play(const std::string& script, const std::vector<std::string>& options = {});
  Outcome run(const std::vector<std::string>& arguments);
  void expectRefused(const std::vector<std::string>& arguments,
                     const std::vector<std::string>& words);
  nlohmann::json report(const std::string& name = "report.json") {
    return nlohmann::json::parse(contentsOf(folder_ / name), nullptr, false);
  }
  std::string at(const std::string& name) { return folder_ / name; }

  TemporaryFolder folder_;
  Display display_;
  std::string scene_;  ///< Path of the scene that play() shows.
};

}  // namespace alpenglow::test
