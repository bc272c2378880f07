// Diagnostic sentences, made without heap or locale, for code that must not throw.
#pragma once

#include <alpenglow/types.h>

#include <charconv>
#include <cstddef>
#include <cstring>

namespace alpenglow::parameters {

/// Text of bounded length; what doesn't fit is cut off. `%g` of printf would follow the host's
/// locale, to_chars doesn't.
class Sentence {
 public:
  Sentence& operator<<(const char* text) {
    while (*text != '\0' && length_ + 1 < sizeof(text_)) {
      text_[length_++] = *text++;
    }
    text_[length_] = '\0';
    return *this;
  }
  Sentence& operator<<(double value) {
    char digits[32];
    const auto [end, error] =
        std::to_chars(digits, digits + sizeof(digits) - 1, value, std::chars_format::general, 9);
    *end = '\0';
    return *this << digits;
  }
  Sentence& operator<<(uint64_t value) {
    char digits[32];
    const auto [end, error] = std::to_chars(digits, digits + sizeof(digits) - 1, value);
    *end = '\0';
    return *this << digits;
  }
  Sentence& operator<<(uint32_t value) { return *this << uint64_t{value}; }
  void copyTo(char* message, size_t messageSize) const {
    if (message == nullptr || messageSize == 0) {
      return;
    }
    const size_t count = length_ < messageSize ? length_ : messageSize - 1;
    std::memcpy(message, text_, count);
    message[count] = '\0';
  }
  const char* text() const { return text_; }

 private:
  char text_[320] = {};
  size_t length_ = 0;
};

/// Reports the sentence as an Error, and returns the status, so that `return report(...)` reads
/// naturally.
inline Status report(const DiagnosticSink& sink, Status status, const Sentence& sentence) {
  if (sink.report != nullptr)
    sink.report(sink.user, {Severity::Error, status, VK_SUCCESS, sentence.text()});
  return status;
}
inline Status report(const DiagnosticSink& sink, Status status, const char* text) {
  return report(sink, status, Sentence() << text);
}

/// The sentence of a function that got null for its result or for an array.
inline Status reportNull(const DiagnosticSink& sink, const char* function, const char* argument) {
  return report(sink, Status::InvalidArgument,
                Sentence() << function << " got null for " << argument << ", but needs it.");
}

}  // namespace alpenglow::parameters
