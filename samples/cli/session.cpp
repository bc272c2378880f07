#include "session.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>

#include "failure.h"

namespace alpenglow::cli {
namespace {

void keepError(void* user, const Diagnostic& diagnostic) {
  if (diagnostic.severity == Severity::Error) {
    *static_cast<std::string*>(user) = diagnostic.message;
  }
}

void addSeconds(std::optional<double>* sum, double seconds) {
  if (seconds >= 0.0) *sum = sum->value_or(0.0) + seconds;
}

}  // namespace

Session::Session(const std::string& device, CapabilityFlags capabilities, CapabilityFlags wishes) {
  headless::DeviceOptions options;
  options.select = device;
  std::map<VkPhysicalDevice, std::string> gaps;
  options.requirements = [&](PFN_vkGetInstanceProcAddr getProcAddr, VkInstance instance,
                             VkPhysicalDevice physicalDevice, Requirements* out,
                             std::string* missing) {
    const auto query = [&](CapabilityFlags flags, std::string* sentence) {
      ContextDesc desc;
      desc.instance = instance;
      desc.physicalDevice = physicalDevice;
      desc.getInstanceProcAddr = getProcAddr;
      desc.capabilities = flags;
      desc.diagnostics = {keepError, sentence};
      return queryRequirements(desc, out);
    };
    std::string& gap = gaps[physicalDevice];
    if (wishes != 0 && query(capabilities | wishes, &gap) == Status::Ok) return Status::Ok;
    return query(capabilities, missing);
  };
  std::string error;
  device_ = headless::Device::create(options, &error);
  if (!device_) throw Failure(error);
  ContextDesc desc = device_->contextDesc();
  unfulfilled_ = gaps[device_->physicalDevice()];
  desc.capabilities = capabilities | (unfulfilled_.empty() ? wishes : CapabilityFlags{0});
  desc.diagnostics = {keepError, &lastError_};
  check(createContext(desc, &context_));
  report_.device = device_->name();
}

Session::~Session() {
  if (context_ != nullptr) destroyContext(context_);
}

void Session::check(Status status) {
  if (status == Status::Ok) return;
  throw Failure(lastError_.empty() ? "Vulkan work failed: " + std::string(statusName(status)) + "."
                                   : lastError_);
}

void Session::nextFrame() {
  check(advanceFrame(context_, frame_ + 1, frame_));
  ++frame_;
}

double Session::run(const std::function<std::string(VkCommandBuffer)>& record) {
  ResourceReport before;
  resourceReport(context_, &before);
  const auto start = std::chrono::steady_clock::now();
  std::string pass;
  std::exception_ptr thrown;  // No exception may cross the headless library.
  const auto guarded = [&](VkCommandBuffer commands) {
    try {
      pass = record(commands);
      return true;
    } catch (...) {
      thrown = std::current_exception();
      return false;
    }
  };
  std::string error;
  headless::Timing timing;
  const bool good = device_->run(guarded, &error, &timing);
  if (thrown) std::rethrow_exception(thrown);
  if (!good) throw Failure(error);
  book(pass, before, timing);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

samples::Gpu Session::gpu() {
  const auto runPass = [this](const char* pass,
                              const std::function<void(VkCommandBuffer)>& record) {
    run([&](VkCommandBuffer commands) {
      record(commands);
      return std::string(pass);
    });
  };
  return {device_.get(), runPass, [this](Status status) { check(status); }};
}

void Session::book(const std::string& pass, const ResourceReport& before,
                   const headless::Timing& timing) {
  auto entry = std::find_if(report_.passes.begin(), report_.passes.end(),
                            [&](const io::ReportPass& p) { return p.name == pass; });
  if (entry == report_.passes.end()) {
    entry = report_.passes.insert(entry, io::ReportPass{pass, 0, 0, 0, {}, {}});
  }
  ResourceReport after;
  resourceReport(context_, &after);
  entry->dispatches += after.dispatches - before.dispatches;
  entry->draws += after.draws - before.draws;
  entry->bytes = std::max({entry->bytes, before.bytes, after.bytes});
  addSeconds(&entry->cpuSeconds, timing.cpuSeconds);
  addSeconds(&entry->gpuSeconds, timing.gpuSeconds);
  report_.totals.images = std::max({report_.totals.images, before.images, after.images});
  report_.totals.buffers = std::max({report_.totals.buffers, before.buffers, after.buffers});
}

headless::HostBuffer Session::hostBuffer(VkDeviceSize size, VkBufferUsageFlags usage) {
  std::string error;
  headless::HostBuffer buffer = device_->createHostBuffer(size, usage, &error);
  if (buffer.buffer() == VK_NULL_HANDLE) throw Failure(error);
  return buffer;
}

headless::Image Session::image(VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
                               uint32_t levels) {
  std::string error;
  headless::Image image = device_->createImage(extent, format, usage, levels, &error);
  if (image.image() == VK_NULL_HANDLE) throw Failure(error);
  return image;
}

io::Report Session::report() {
  ResourceReport now;
  resourceReport(context_, &now);
  io::Report report = report_;
  report.totals.pipelines = now.pipelines;
  report.totals.shaderVariants = now.shaderVariants;
  report.totals.bytes = now.peakBytes;
  report.totals.dispatches = now.dispatches;
  report.totals.draws = now.draws;
  report.totals.images = std::max(report.totals.images, now.images);
  report.totals.buffers = std::max(report.totals.buffers, now.buffers);
  return report;
}

PFN_vkVoidFunction Session::requireInstanceFunction(const char* name) {
  const PFN_vkVoidFunction found = device_->getInstanceProcAddr()(device_->instance(), name);
  if (found == nullptr) throw Failure(std::string("The driver lacks ") + name + ".");
  return found;
}

PFN_vkVoidFunction Session::requireFunction(const char* name) {
  const PFN_vkVoidFunction found = device_->function(name);
  if (found == nullptr) throw Failure(std::string("The driver lacks ") + name + ".");
  return found;
}

}  // namespace alpenglow::cli
