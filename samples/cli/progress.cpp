#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace alpenglow::cli {

Progress::Progress(std::string title)
    : title_(std::move(title)),
      start_(std::chrono::steady_clock::now()),
      terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (drawn_) std::fputs("\r\x1b[K", stderr);
}

void Progress::update(double done, const std::string& detail) {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  if (!terminal_ || elapsed.count() < 1.0) return;
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(std::clamp(done, 0.0, 1.0) * kWidth);
  std::string bar(static_cast<size_t>(filled), '#');
  bar.resize(kWidth, '.');
  std::fprintf(stderr, "\r%s [%s] %3.0f %%  %s\x1b[K", title_.c_str(), bar.c_str(), 100.0 * done,
               detail.c_str());
  drawn_ = true;
}

}  // namespace alpenglow::cli
