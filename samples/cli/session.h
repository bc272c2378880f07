// A device with a context on it, and the account of what ran there.
#pragma once

#include <alpenglow/headless.h>
#include <alpenglow/io/report_file.h>
#include <alpenglow/tables.h>

#include <functional>
#include <memory>
#include <string>

#include "common/gpu.h"

namespace alpenglow::cli {

class Session {
 public:
  /// Takes what of `wishes` the device has, too. Throws a Failure when there is no suitable device.
  Session(const std::string& device, CapabilityFlags capabilities, CapabilityFlags wishes = 0);
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
  ~Session();

  headless::Device& device() { return *device_; }
  Context* context() { return context_; }
  /// For what a sample's scene needs on this device; the session outlives it.
  samples::Gpu gpu();
  /// Why the device has none of the wishes; empty where it has them.
  const std::string& unfulfilled() const { return unfulfilled_; }

  /// Throws a Failure with the library's own sentence unless the status is Ok.
  void check(Status status);

  /// Records, submits, waits; `record` returns the name of the pass that the work is booked on and
  /// may throw. Returns the seconds that it took by the clock.
  double run(const std::function<std::string(VkCommandBuffer)>& record);
  /// All that was run is a frame of the library's, and has completed.
  void nextFrame();

  headless::HostBuffer hostBuffer(VkDeviceSize size, VkBufferUsageFlags usage);
  headless::Image image(VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
                        uint32_t levels);

  /// A device function by the type of its pointer: function<PFN_vkCmdDraw>("vkCmdDraw").
  template <typename Function>
  Function function(const char* name) {
    return reinterpret_cast<Function>(requireFunction(name));
  }

  /// As function, for those that take the instance or the physical device.
  template <typename Function>
  Function instanceFunction(const char* name) {
    return reinterpret_cast<Function>(requireInstanceFunction(name));
  }

  /// What was done until now.
  io::Report report();

 private:
  PFN_vkVoidFunction requireFunction(const char* name);
  PFN_vkVoidFunction requireInstanceFunction(const char* name);
  void book(const std::string& pass, const ResourceReport& before, const headless::Timing& timing);

  std::unique_ptr<headless::Device> device_;
  Context* context_ = nullptr;
  uint64_t frame_ = 1;  ///< That is recorded now.
  std::string lastError_;
  std::string unfulfilled_;
  io::Report report_;
};

/// Tables and views, destroyed before their session.
struct TablesDeleter {
  Session* session = nullptr;
  void operator()(Tables* tables) const { destroyTables(tables); }
};
using TablesPointer = std::unique_ptr<Tables, TablesDeleter>;

}  // namespace alpenglow::cli
