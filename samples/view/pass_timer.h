// What each pass of a frame costs, by timestamps.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "presenter.h"

namespace alpenglow::view {

class PassTimer {
 public:
  explicit PassTimer(const samples::Gpu* gpu);

  /// Reads what the slot's last frame took, and starts over. Outside rendering scopes.
  void begin(const Frame& frame);
  /// Times what `record` records; around rendering scopes, or inside one.
  template <typename Record>
  void time(const Frame& frame, const char* pass, const Record& record) {
    mark(frame, pass);
    record();
    mark(frame, nullptr);
  }

  static constexpr size_t kKept = 128;
  /// The last frames' milliseconds, oldest first; 0 where a pass wasn't run.
  struct History {
    std::array<float, kKept> milliseconds = {};
    float last = 0.0f;  ///< When it ran last.
  };
  const std::map<std::string, History>& passes() const { return passes_; }
  /// Seconds of a pass in the frame that begin() read; 0 if it wasn't run.
  double seconds(const std::string& pass) const;
  /// All of them.
  double seconds() const;
  /// Seconds of each piece of that frame that time() was called for, in order.
  std::vector<double> pieces(const std::string& pass) const;

 private:
  void mark(const Frame& frame, const char* pass);

  const samples::Gpu* gpu_;
  Functions vk_;
  uint64_t mask_ = 0;    ///< The bits that a timestamp has.
  double period_ = 0.0;  ///< Seconds a tick; 0: the device has no timestamps.
  struct Slot {
    samples::Owned<VkQueryPool> queries;
    std::vector<const char*> names;
    uint32_t marks = 0;
  };
  Slot slots_[kFramesInFlight];
  std::map<std::string, History> passes_;
  std::vector<std::pair<std::string, double>> pieces_;
};

}  // namespace alpenglow::view
