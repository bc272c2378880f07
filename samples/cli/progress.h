// A bar on stderr, for people who wait: only on a terminal, and only after a second.
#pragma once

#include <chrono>
#include <string>

namespace alpenglow::cli {

class Progress {
 public:
  explicit Progress(std::string title);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  /// Wipes the bar.
  ~Progress();
  /// `done` from 0 to 1; `detail` is what is done now.
  void update(double done, const std::string& detail);

 private:
  std::string title_;
  std::chrono::steady_clock::time_point start_;
  bool terminal_;
  bool drawn_ = false;
};

}  // namespace alpenglow::cli
