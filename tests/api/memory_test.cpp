// Memory: the host's hooks and allocation callbacks are used, and paired; recording allocates
// nothing.
#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>
#include <set>

#include "tests/passes/sky/sky_fixture.h"

namespace {
thread_local bool counting = false;
thread_local int newCalls = 0;
}  // namespace

// Every operator new of this program, counted where a test asks for it on its thread.
void* operator new(std::size_t size) {
  if (counting) ++newCalls;
  void* const memory = std::malloc(size != 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void* operator new[](std::size_t size) { return operator new(size); }
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  if (counting) ++newCalls;
  return std::malloc(size != 0 ? size : 1);
}
void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept {
  return operator new(size, tag);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

namespace alpenglow::testing {
namespace {

/// A host's allocator: every range lies behind an offset in a VkDeviceMemory of its own.
struct Hooks {
  headless::Device* device = nullptr;
  int allocations = 0;
  int refuseAt = -1;
  std::map<VkDeviceMemory, VkDeviceSize> alive;  ///< To the offset handed out.
  std::set<std::string> names;

  MemoryHooks hooks() {
    MemoryHooks hooks;
    hooks.user = this;
    hooks.allocate = [](void* user, const VkMemoryRequirements& needed, uint32_t type, bool mustMap,
                        const char* name, MemoryRange* range) {
      return static_cast<Hooks*>(user)->allocate(needed, type, mustMap, name, range);
    };
    hooks.free = [](void* user, const MemoryRange& range) {
      static_cast<Hooks*>(user)->release(range);
    };
    return hooks;
  }

  VkResult allocate(const VkMemoryRequirements& needed, uint32_t type, bool mustMap,
                    const char* name, MemoryRange* range) {
    if (allocations++ == refuseAt) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    EXPECT_NE(needed.memoryTypeBits >> type & 1u, 0u);
    names.insert(name);
    VkMemoryAllocateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.allocationSize = needed.size + 3 * needed.alignment;
    info.memoryTypeIndex = type;
    range->offset = 3 * needed.alignment;
    const VkResult result = reinterpret_cast<PFN_vkAllocateMemory>(
        device->function("vkAllocateMemory"))(device->device(), &info, nullptr, &range->memory);
    if (result != VK_SUCCESS) return result;
    alive[range->memory] = range->offset;
    // Freeing the memory unmaps it.
    return mustMap
               ? reinterpret_cast<PFN_vkMapMemory>(device->function("vkMapMemory"))(
                     device->device(), range->memory, range->offset, needed.size, 0, &range->mapped)
               : VK_SUCCESS;
  }

  void release(const MemoryRange& range) {
    const auto found = alive.find(range.memory);
    ASSERT_NE(found, alive.end());
    EXPECT_EQ(found->second, range.offset);
    alive.erase(found);
    reinterpret_cast<PFN_vkFreeMemory>(device->function("vkFreeMemory"))(device->device(),
                                                                         range.memory, nullptr);
  }
};

TEST_F(StandardSkyTest, HooksServeAllMemory) {
  Hooks host;
  host.device = &device();
  ContextDesc desc = contextDesc();
  Context* made = nullptr;
  desc.memory = host.hooks();
  ASSERT_EQ(createContext(desc, &made), Status::Ok);
  Tables* baked = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), smallTables(), &baked), Status::Ok);
  const size_t whileBaking = host.alive.size();
  bakeAll(device(), baked);
  ProbeQuery query;
  query.zenith = 1.0;
  EXPECT_EQ(probe(device(), baked, {query}).at(0).skyRadiance[1],
            probeAll({query}).at(0).skyRadiance[1]);
  finishFrames(made);
  EXPECT_LT(host.alive.size(), whileBaking) << "the scratch block is still there";
  EXPECT_GE(host.allocations, 4);
  EXPECT_EQ(host.names.count("Alpenglow tables"), 1u);
  ResourceReport report;
  resourceReport(made, &report);
  EXPECT_GT(report.bytes, 0u);
  destroyTables(baked);
  finishFrames(made);
  EXPECT_TRUE(host.alive.empty());
  resourceReport(made, &report);
  EXPECT_EQ(report.bytes, 0u);
  destroyContext(made);
}

TEST_F(StandardSkyTest, RefusingHooksLeaveNothing) {
  Hooks host;
  host.device = &device();
  ContextDesc desc = contextDesc();
  desc.memory = host.hooks();
  Context* made = nullptr;
  ASSERT_EQ(createContext(desc, &made), Status::Ok);
  for (int n = 0; n < 3; ++n) {
    host.refuseAt = host.allocations + n;
    Tables* none = nullptr;
    EXPECT_EQ(createTables(made, preset("earth"), smallTables(), &none), Status::OutOfDeviceMemory);
    EXPECT_EQ(none, nullptr);
    EXPECT_NE(lastDiagnostic().find("hook refused"), std::string::npos) << lastDiagnostic();
    EXPECT_TRUE(host.alive.empty()) << n;
  }
  destroyContext(made);
}

/// A host's allocator that takes every mapped range from one VkDeviceMemory, which it maps once.
struct Pool {
  static constexpr VkDeviceSize kBytes = 1 << 16;
  Hooks dedicated;  ///< For the rest.
  VkDeviceMemory memory = VK_NULL_HANDLE;
  uint32_t type = 0;
  char* mapped = nullptr;
  VkDeviceSize end = 0;
  std::map<VkDeviceSize, void*> alive;  ///< By offset.
  size_t mostAlive = 0;

  template <class Function>
  Function function(const char* name) {
    return reinterpret_cast<Function>(dedicated.device->function(name));
  }

  MemoryHooks hooks() {
    MemoryHooks hooks;
    hooks.user = this;
    hooks.allocate = [](void* user, const VkMemoryRequirements& needed, uint32_t index,
                        bool mustMap, const char* name, MemoryRange* range) {
      Pool& self = *static_cast<Pool*>(user);
      if (!mustMap) return self.dedicated.allocate(needed, index, mustMap, name, range);
      return self.allocate(needed, index, range);
    };
    hooks.free = [](void* user, const MemoryRange& range) {
      Pool& self = *static_cast<Pool*>(user);
      if (range.memory != self.memory) return self.dedicated.release(range);
      const auto found = self.alive.find(range.offset);
      ASSERT_NE(found, self.alive.end());
      EXPECT_EQ(found->second, range.mapped);
      self.alive.erase(found);
    };
    return hooks;
  }

  VkResult allocate(const VkMemoryRequirements& needed, uint32_t index, MemoryRange* range) {
    if (memory == VK_NULL_HANDLE) {
      VkMemoryAllocateInfo info = {};
      info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
      info.allocationSize = kBytes;
      info.memoryTypeIndex = type = index;
      VkDevice device = dedicated.device->device();
      VkResult result =
          function<PFN_vkAllocateMemory>("vkAllocateMemory")(device, &info, nullptr, &memory);
      if (result != VK_SUCCESS) return result;
      void* first = nullptr;
      result = function<PFN_vkMapMemory>("vkMapMemory")(device, memory, 0, kBytes, 0, &first);
      if (result != VK_SUCCESS) return result;
      mapped = static_cast<char*>(first);
    }
    const VkDeviceSize offset = (end + needed.alignment - 1) / needed.alignment * needed.alignment;
    if (index != type || offset + needed.size > kBytes) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    end = offset + needed.size;
    *range = {memory, offset, mapped + offset};
    alive[offset] = range->mapped;
    mostAlive = std::max(mostAlive, alive.size());
    return VK_SUCCESS;
  }

  void destroy() {
    VkDevice device = dedicated.device->device();
    function<PFN_vkUnmapMemory>("vkUnmapMemory")(device, memory);
    function<PFN_vkFreeMemory>("vkFreeMemory")(device, memory, nullptr);
  }
};

// Were one range mapped or unmapped by us, the validation layer would name it: the fixture fails.
TEST_F(StandardSkyTest, MappedRangesShareOneMemory) {
  Pool pool;
  pool.dedicated.device = &device();
  ContextDesc desc = contextDesc();
  desc.memory = pool.hooks();
  Context* made = nullptr;
  ASSERT_EQ(createContext(desc, &made), Status::Ok);
  Tables* first = nullptr;
  Tables* second = nullptr;
  ASSERT_EQ(createTables(made, preset("mars"), smallTables(), &first), Status::Ok)
      << lastDiagnostic();
  ASSERT_EQ(createTables(made, preset("earth"), smallTables(), &second), Status::Ok)
      << lastDiagnostic();
  EXPECT_EQ(pool.alive.size(), 2u);
  destroyTables(first);
  finishFrames(made);
  EXPECT_EQ(pool.alive.size(), 1u);
  // The second range and those to come are still mapped.
  bakeAll(device(), second);
  ProbeQuery query;
  query.zenith = 1.0;
  EXPECT_EQ(probe(device(), second, {query}).at(0).skyRadiance[1],
            probeAll({query}).at(0).skyRadiance[1]);
  EXPECT_EQ(pool.mostAlive, 2u);
  destroyTables(second);
  destroyContext(made);
  EXPECT_TRUE(pool.alive.empty());
  EXPECT_TRUE(pool.dedicated.alive.empty());
  pool.destroy();
}

/// Callbacks that keep a size before each block and count.
struct Counter {
  std::atomic<int> alive{0}, total{0};
  VkAllocationCallbacks callbacks = {};

  Counter() {
    callbacks.pUserData = this;
    callbacks.pfnAllocation = [](void* user, size_t size, size_t alignment,
                                 VkSystemAllocationScope) {
      return static_cast<Counter*>(user)->allocate(size, alignment);
    };
    callbacks.pfnReallocation = [](void* user, void* old, size_t size, size_t alignment,
                                   VkSystemAllocationScope) {
      return static_cast<Counter*>(user)->reallocate(old, size, alignment);
    };
    callbacks.pfnFree = [](void* user, void* memory) {
      static_cast<Counter*>(user)->release(memory);
    };
  }
  // The size and the start of the block lie in the 32 bytes before what is handed out.
  void* allocate(size_t size, size_t alignment) {
    const size_t step = std::max<size_t>(alignment, 32);
    auto* const start = static_cast<char*>(std::malloc(size + 2 * step));
    auto* const memory =
        reinterpret_cast<char*>((reinterpret_cast<uintptr_t>(start) + 2 * step - 1) / step * step);
    reinterpret_cast<size_t*>(memory)[-1] = size;
    reinterpret_cast<void**>(memory)[-2] = start;
    ++alive;
    ++total;
    return memory;
  }
  void* reallocate(void* old, size_t size, size_t alignment) {
    if (old == nullptr) return allocate(size, alignment);
    if (size == 0) {
      release(old);
      return nullptr;
    }
    void* const memory = allocate(size, alignment);
    std::memcpy(memory, old, std::min(size, reinterpret_cast<size_t*>(old)[-1]));
    release(old);
    return memory;
  }
  void release(void* memory) {
    if (memory == nullptr) return;
    --alive;
    std::free(reinterpret_cast<void**>(memory)[-2]);
  }
};

TEST_F(StandardSkyTest, AllocationCallbacksArePaired) {
  Counter counter;
  ContextDesc desc = contextDesc();
  desc.allocator = &counter.callbacks;
  Context* made = nullptr;
  ASSERT_EQ(createContext(desc, &made), Status::Ok);
  Tables* baked = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), smallTables(), &baked), Status::Ok);
  bakeAll(device(), baked);
  View* view = nullptr;
  ViewDesc viewDesc;
  viewDesc.sky = SkyMethod::Integrate;
  viewDesc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  ASSERT_EQ(createView(made, baked, viewDesc, &view), Status::Ok);
  EXPECT_EQ(probe(device(), baked, {ProbeQuery{}}).size(), 1u);
  EXPECT_GT(counter.alive, 10);  // Not every driver asks for every object.
  destroyView(view);
  destroyTables(baked);
  destroyContext(made);
  EXPECT_EQ(counter.alive, 0);
}

// After warm-up, slices of a bake and draws allocate nothing: no operator new on this thread, none
// of the device's objects. On a device without layers, which allocate for themselves.
TEST_F(StandardSkyTest, RecordingAllocatesNothing) {
  std::string error;
  const auto bare = headless::Device::create({}, &error);
  ASSERT_NE(bare, nullptr) << error;
  Counter counter;
  ContextDesc desc = bare->contextDesc();
  desc.allocator = &counter.callbacks;
  Context* made = nullptr;
  ASSERT_EQ(createContext(desc, &made), Status::Ok);
  Tables* baked = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), smallTables(), &baked), Status::Ok);
  BakeProgress progress;
  int slices = 0, allocations = 0, objects = 0;
  // The last slice queues the scratch images for destruction: that may grow the queue.
  while (!progress.done) {
    const bool last = progress.passIndex + 1 == progress.passCount;
    ASSERT_TRUE(bare->run(
        [&](VkCommandBuffer commands) {
          const int before = counter.total;
          newCalls = 0;
          counting = true;
          const Status status = recordBake(baked, commands, 1000000, &progress);
          counting = false;
          slices += last ? 0 : 1;
          allocations += last ? 0 : newCalls;
          objects += counter.total - before;
          return status == Status::Ok;
        },
        &error))
        << error;
  }
  EXPECT_GT(slices, 10);
  EXPECT_EQ(allocations, 0);
  EXPECT_EQ(objects, 0);

  View* view = nullptr;
  ViewDesc viewDesc;
  viewDesc.sky = SkyMethod::Integrate;
  viewDesc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  ASSERT_EQ(createView(made, baked, viewDesc, &view), Status::Ok);
  FrameState draw = makeDraw(cameraFromGeodetic(preset("earth"), 0.0, 0.0, 2.0, 0.0, 0.1, 0.0, 1.0),
                             {0.6, 0.0, 0.8}, {24, 16});
  TargetDesc targetDesc;
  targetDesc.extent = draw.viewport.extent;
  Target target(*bare, targetDesc);
  for (int frame = 0; frame < 4; ++frame) {
    draw.camera = cameraFromGeodetic(preset("earth"), 0.0, 0.0, 2.0 + 1e5 * frame, 0.0, 0.5 * frame,
                                     0.0, 1.0);
    target.draw([&](VkCommandBuffer commands) {
      const int before = counter.total;
      newCalls = 0;
      counting = true;
      const Status status = testing::recordSky(view, commands, baked, draw);
      counting = false;
      EXPECT_EQ(newCalls, 0);
      EXPECT_EQ(counter.total, before);
      return status == Status::Ok;
    });
  }
  destroyView(view);
  destroyTables(baked);
  destroyContext(made);
  EXPECT_EQ(counter.alive, 0);
}

}  // namespace
}  // namespace alpenglow::testing
