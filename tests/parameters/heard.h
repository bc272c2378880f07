// What a function reports to its sink, and the presets as a range.
#pragma once

#include <alpenglow/parameters.h>

#include <span>
#include <string>

namespace alpenglow::testing {

/// Keeps the last report, and counts them.
struct Heard {
  std::string sentence;
  Severity severity = Severity::Info;
  Status status = Status::Ok;
  int count = 0;

  DiagnosticSink sink() {
    return {[](void* user, const Diagnostic& diagnostic) {
              auto* heard = static_cast<Heard*>(user);
              heard->sentence = diagnostic.message;
              heard->severity = diagnostic.severity;
              heard->status = diagnostic.status;
              ++heard->count;
            },
            this};
  }
};

inline std::span<const Preset> allPresets() {
  uint32_t count = 0;
  const Preset* const first = presets(&count);
  return {first, count};
}

}  // namespace alpenglow::testing
