#include "pass_timer.h"

#include <algorithm>

namespace alpenglow::view {
namespace {

constexpr uint32_t kMostMarks = 96;

}  // namespace

PassTimer::PassTimer(const samples::Gpu* gpu) : gpu_(gpu), vk_(*gpu) {
  const headless::Device& device = gpu->device();
  VkPhysicalDeviceProperties properties = {};
  reinterpret_cast<PFN_vkGetPhysicalDeviceProperties>(device.getInstanceProcAddr()(
      device.instance(), "vkGetPhysicalDeviceProperties"))(device.physicalDevice(), &properties);
  const auto getFamilies = reinterpret_cast<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
      device.getInstanceProcAddr()(device.instance(), "vkGetPhysicalDeviceQueueFamilyProperties"));
  uint32_t count = 0;
  getFamilies(device.physicalDevice(), &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  getFamilies(device.physicalDevice(), &count, families.data());
  const uint32_t bits = families[device.queueFamily()].timestampValidBits;
  if (bits == 0) return;
  mask_ = bits < 64 ? (uint64_t{1} << bits) - 1 : UINT64_MAX;
  period_ = 1e-9 * static_cast<double>(properties.limits.timestampPeriod);
  for (Slot& slot : slots_) {
    VkQueryPoolCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = kMostMarks;
    slot.queries = make<VkQueryPool>(*gpu, vk_.CreateQueryPool, info, "vkDestroyQueryPool");
  }
}

void PassTimer::begin(const Frame& frame) {
  if (period_ == 0.0) return;
  Slot& slot = slots_[frame.slot];
  uint64_t ticks[kMostMarks] = {};
  if (slot.marks > 0) {
    samples::Gpu::check(
        vk_.GetQueryPoolResults(gpu_->device().device(), slot.queries.get(), 0, slot.marks,
                                sizeof ticks, ticks, sizeof ticks[0], VK_QUERY_RESULT_64_BIT),
        "vkGetQueryPoolResults");
  }
  for (auto& [name, history] : passes_) {
    std::rotate(history.milliseconds.begin(), history.milliseconds.begin() + 1,
                history.milliseconds.end());
    history.milliseconds.back() = 0.0f;
  }
  pieces_.clear();
  for (uint32_t i = 0; i + 1 < slot.marks; i += 2) {
    const char* name = slot.names[i / 2];
    pieces_.emplace_back(name, period_ * static_cast<double>((ticks[i + 1] - ticks[i]) & mask_));
    History& history = passes_[name];
    history.last = static_cast<float>(1e3 * pieces_.back().second);
    history.milliseconds.back() += history.last;
  }
  vk_.CmdResetQueryPool(frame.commands, slot.queries.get(), 0, kMostMarks);
  slot.marks = 0;
  slot.names.clear();
}

void PassTimer::mark(const Frame& frame, const char* pass) {
  Slot& slot = slots_[frame.slot];
  if (period_ == 0.0 || slot.marks >= kMostMarks) return;
  if (pass != nullptr) slot.names.push_back(pass);
  vk_.CmdWriteTimestamp2(frame.commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slot.queries.get(),
                         slot.marks++);
}

double PassTimer::seconds(const std::string& pass) const {
  const auto found = passes_.find(pass);
  return found == passes_.end() ? 0.0 : 1e-3 * double{found->second.milliseconds.back()};
}

double PassTimer::seconds() const {
  double sum = 0.0;
  for (const auto& [name, history] : passes_) sum += 1e-3 * double{history.milliseconds.back()};
  return sum;
}

std::vector<double> PassTimer::pieces(const std::string& pass) const {
  std::vector<double> seconds;
  for (const auto& [name, time] : pieces_) {
    if (name == pass) seconds.push_back(time);
  }
  return seconds;
}

}  // namespace alpenglow::view
