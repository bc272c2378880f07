// Allocation callbacks that count what is alive.
#pragma once

#include <vulkan/vulkan_core.h>

#include <atomic>
#include <cstdlib>

namespace alpenglow::testing {

/// What malloc aligns to is enough for the drivers that tests use. A driver may call from any
/// thread.
class CountingAllocator {
 public:
  CountingAllocator() {
    callbacks_.pUserData = this;
    callbacks_.pfnAllocation = [](void* user, size_t size, size_t, VkSystemAllocationScope) {
      return self(user).count(std::malloc(size));
    };
    callbacks_.pfnReallocation = [](void* user, void* old, size_t size, size_t,
                                    VkSystemAllocationScope) {
      return old == nullptr ? self(user).count(std::malloc(size)) : std::realloc(old, size);
    };
    callbacks_.pfnFree = [](void* user, void* memory) {
      if (memory != nullptr) --self(user).alive;
      std::free(memory);
    };
  }
  CountingAllocator(const CountingAllocator&) = delete;
  CountingAllocator& operator=(const CountingAllocator&) = delete;

  const VkAllocationCallbacks* callbacks() const { return &callbacks_; }
  std::atomic<int> alive{0};
  std::atomic<int> total{0};

 private:
  static CountingAllocator& self(void* user) { return *static_cast<CountingAllocator*>(user); }
  void* count(void* memory) {
    ++alive;
    ++total;
    return memory;
  }

  VkAllocationCallbacks callbacks_ = {};
};

}  // namespace alpenglow::testing
