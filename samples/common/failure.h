// How the program ends early: a Failure holds the one sentence that stderr gets.
#pragma once

#include <alpenglow/io/result.h>

#include <stdexcept>
#include <string>

namespace alpenglow::samples {

class Failure : public std::runtime_error {
 public:
  explicit Failure(const std::string& sentence, int exitStatus = kFailed)
      : std::runtime_error(sentence), exitStatus_(exitStatus) {}
  int exitStatus() const { return exitStatus_; }

  static constexpr int kFailed = 1;
  static constexpr int kUsage = 2;

 private:
  int exitStatus_;
};

template <typename T>
T take(io::Result<T> result) {
  if (!result) throw Failure(result.error);
  return std::move(*result.value);
}
void check(const io::Done& done);

/// Writes text to an output file, or throws.
void writeText(const std::string& path, const std::string& text);

}  // namespace alpenglow::samples
