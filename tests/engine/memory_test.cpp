#include "engine/memory.h"

#include <gtest/gtest.h>

#include "tests/engine/mock_vulkan.h"

namespace alpenglow::engine {
namespace {

using testing::MockVulkan;

constexpr VkMemoryPropertyFlags kLocal = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
constexpr VkMemoryPropertyFlags kHost =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

/// A host's allocator that hands out ranges of one VkDeviceMemory.
struct Hooks {
  MemoryHooks hooks;
  VkResult result = VK_SUCCESS;
  MemoryRange answer = {handleFrom<VkDeviceMemory>(5000), 4096, nullptr};
  VkMemoryRequirements asked = {};
  uint32_t type = 99;
  bool mustMap = false;
  std::string name;
  int allocated = 0;
  int freed = 0;

  Hooks() {
    hooks.user = this;
    hooks.allocate = [](void* user, const VkMemoryRequirements& requirements, uint32_t typeIndex,
                        bool mapIt, const char* blockName, MemoryRange* range) {
      auto* self = static_cast<Hooks*>(user);
      self->asked = requirements;
      self->type = typeIndex;
      self->mustMap = mapIt;
      self->name = blockName;
      if (self->result == VK_SUCCESS) {
        ++self->allocated;
        *range = self->answer;
      }
      return self->result;
    };
    hooks.free = [](void* user, const MemoryRange& range) {
      auto* self = static_cast<Hooks*>(user);
      if (range.offset == self->answer.offset) ++self->freed;
    };
  }
};

class MemoryTest : public ::testing::Test {
 protected:
  ~MemoryTest() override {
    for (Image& image : images_) destroyImage(*device_, &image);
    for (Buffer& buffer : buffers_) destroyBuffer(*device_, &buffer);
    freeBlock(*device_, &block_);
    Device::destroy(device_);
    EXPECT_TRUE(mock_.alive.empty());
    for (const std::string& mistake : mock_.mistakes) ADD_FAILURE() << mistake;
  }

  void make(size_t imageCount, size_t bufferCount, const MemoryHooks* hooks = nullptr) {
    DeviceDesc desc = mock_.deviceDesc();
    desc.memory = hooks;
    ASSERT_EQ(Device::create(desc, &device_), Status::Ok);
    images_.resize(imageCount);
    buffers_.resize(bufferCount);
    for (Image& image : images_) {
      ImageDesc imageDesc;
      imageDesc.format = VK_FORMAT_R8G8B8A8_UNORM;
      imageDesc.extent = {8, 8, 1};
      imageDesc.usage = VK_IMAGE_USAGE_STORAGE_BIT;
      imageDesc.name = "table";
      ASSERT_EQ(createImage(*device_, imageDesc, &image), Status::Ok);
      imagePointers_.push_back(&image);
    }
    for (Buffer& buffer : buffers_) {
      ASSERT_EQ(createBuffer(*device_, 64, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT, "b", &buffer),
                Status::Ok);
      bufferPointers_.push_back(&buffer);
    }
  }
  Status bind(VkMemoryPropertyFlags properties) {
    return allocateAndBind(*device_, "block", properties, imagePointers_.data(),
                           static_cast<uint32_t>(images_.size()), bufferPointers_.data(),
                           static_cast<uint32_t>(buffers_.size()), &block_);
  }

  MockVulkan mock_;
  Hooks hooks_;  // Outlives the device, as a host's must.
  Device* device_ = nullptr;
  std::vector<Image> images_;
  std::vector<Buffer> buffers_;
  std::vector<Image*> imagePointers_;
  std::vector<Buffer*> bufferPointers_;
  MemoryBlock block_;
};

TEST_F(MemoryTest, EachResourceStartsAtItsAlignment) {
  mock_.imageRequirements = {{1000, 256, 3}, {10, 512, 3}, {7, 64, 3}};
  mock_.bufferRequirements = {{100, 16, 3}, {50, 32, 3}};
  make(3, 2);
  ASSERT_EQ(bind(kLocal), Status::Ok) << mock_.lastDiagnostic();
  ASSERT_EQ(mock_.bindings.size(), 5u);
  const VkDeviceSize expected[] = {0, 1024, 1088, 1104, 1216};
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(mock_.bindings[i].offset, expected[i]) << i;
  EXPECT_EQ(block_.size, 1266u);
  ASSERT_EQ(mock_.allocations.size(), 1u);
  EXPECT_EQ(mock_.allocations[0].allocationSize, 1266u);
  EXPECT_EQ(mock_.allocations[0].memoryTypeIndex, 0u);
  EXPECT_EQ(images_[1].bytes, 10u);
  EXPECT_EQ(mock_.aliveCount("ImageView"), 3);
  EXPECT_EQ(block_.mapped, nullptr);
}

TEST_F(MemoryTest, GranularityKeepsBuffersOffTheImagesPage) {
  mock_.properties.limits.bufferImageGranularity = 4096;
  mock_.imageRequirements = {{1000, 256, 3}};
  make(2, 2, &hooks_.hooks);
  ASSERT_EQ(bind(kLocal), Status::Ok);
  ASSERT_EQ(mock_.bindings.size(), 4u);
  EXPECT_EQ(mock_.bindings[1].offset, 4096u + 1024u);
  EXPECT_EQ(mock_.bindings[2].offset, 4096u + 4096u);
  EXPECT_EQ(mock_.bindings[3].offset, 4096u + 4208u);
  // The pages count from the start of the memory, so the block itself starts on one.
  EXPECT_EQ(hooks_.asked.alignment, 4096u);
}

TEST_F(MemoryTest, GranularityCostsNothingWithoutAMixture) {
  mock_.properties.limits.bufferImageGranularity = 4096;
  make(0, 2, &hooks_.hooks);
  ASSERT_EQ(bind(kLocal), Status::Ok);
  EXPECT_EQ(hooks_.asked.alignment, 16u);
  EXPECT_EQ(hooks_.asked.size, 212u);
}

TEST_F(MemoryTest, HooksServeTheBlockAndTakeItBack) {
  make(1, 0, &hooks_.hooks);
  ASSERT_EQ(bind(kLocal), Status::Ok);
  EXPECT_EQ(mock_.count("vkAllocateMemory"), 0);
  EXPECT_EQ(hooks_.allocated, 1);
  EXPECT_EQ(hooks_.type, 0u);
  EXPECT_EQ(hooks_.name, "block");
  EXPECT_EQ(hooks_.asked.size, 1000u);
  EXPECT_EQ(hooks_.asked.alignment, 256u);
  EXPECT_EQ(mock_.bindings[0].memory, hooks_.answer.memory);
  EXPECT_EQ(mock_.bindings[0].offset, hooks_.answer.offset);
  EXPECT_EQ(device_->counters().bytes, 1000u);
  freeBlock(*device_, &block_);
  EXPECT_EQ(hooks_.freed, 1);
  EXPECT_EQ(mock_.count("vkFreeMemory"), 0);
  EXPECT_EQ(device_->counters().bytes, 0u);
  EXPECT_EQ(device_->counters().peakBytes, 1000u);
}

TEST_F(MemoryTest, RefusingHookIsOutOfDeviceMemory) {
  hooks_.result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  make(1, 0, &hooks_.hooks);
  EXPECT_EQ(bind(kLocal), Status::OutOfDeviceMemory);
  EXPECT_EQ(mock_.lastDiagnostic(),
            "The host's memory hook refused 1000 bytes for block \"block\": "
            "VK_ERROR_OUT_OF_DEVICE_MEMORY (-2).");
  EXPECT_EQ(hooks_.freed, 0);
  EXPECT_EQ(block_.range.memory, handleFrom<VkDeviceMemory>(0));
  EXPECT_EQ(device_->counters().bytes, 0u);
}

TEST_F(MemoryTest, MisalignedHookAnswerIsGivenBack) {
  hooks_.answer.offset = 100;
  make(1, 0, &hooks_.hooks);
  EXPECT_EQ(bind(kLocal), Status::InvalidArgument);
  EXPECT_EQ(hooks_.freed, 1);
  EXPECT_NE(mock_.lastDiagnostic().find("offset 100"), std::string::npos);
  EXPECT_NE(mock_.lastDiagnostic().find("multiple of 256"), std::string::npos);
}

TEST_F(MemoryTest, HookThatAnswersNoMemoryIsRefused) {
  hooks_.answer.memory = VK_NULL_HANDLE;
  make(1, 0, &hooks_.hooks);
  EXPECT_EQ(bind(kLocal), Status::InvalidArgument);
  EXPECT_EQ(hooks_.freed, 0);
}

TEST_F(MemoryTest, HostVisibleBlockIsMappedForEachBuffer) {
  make(0, 2);
  ASSERT_EQ(bind(kHost), Status::Ok);
  EXPECT_EQ(mock_.allocations[0].memoryTypeIndex, 1u);
  EXPECT_EQ(block_.mapped, mock_.mapped.data());
  EXPECT_EQ(buffers_[0].mapped, mock_.mapped.data());
  EXPECT_EQ(buffers_[1].mapped, mock_.mapped.data() + 112);
  freeBlock(*device_, &block_);
  EXPECT_EQ(mock_.count("vkUnmapMemory"), 1);
}

TEST_F(MemoryTest, HookMapsTheHostVisibleBlock) {
  std::byte bytes[256];
  hooks_.answer.mapped = bytes;
  make(0, 2, &hooks_.hooks);
  ASSERT_EQ(bind(kHost), Status::Ok) << mock_.lastDiagnostic();
  EXPECT_TRUE(hooks_.mustMap);
  EXPECT_EQ(hooks_.type, 1u);
  EXPECT_EQ(buffers_[0].mapped, bytes);
  EXPECT_EQ(buffers_[1].mapped, bytes + 112);
  freeBlock(*device_, &block_);
  EXPECT_EQ(hooks_.freed, 1);
  EXPECT_EQ(mock_.count("vkMapMemory"), 0);
  EXPECT_EQ(mock_.count("vkUnmapMemory"), 0);
}

TEST_F(MemoryTest, HookThatDoesNotMapIsRefused) {
  make(0, 2, &hooks_.hooks);
  EXPECT_EQ(bind(kHost), Status::InvalidArgument);
  EXPECT_EQ(mock_.lastDiagnostic(),
            "The host's memory hook answered memory with a null mapped pointer for block "
            "\"block\", but with mustMap it must keep the range mapped and set "
            "MemoryRange::mapped.");
  EXPECT_EQ(hooks_.freed, 1);
  EXPECT_EQ(mock_.count("vkMapMemory"), 0);
  EXPECT_EQ(buffers_[0].mapped, nullptr);
  EXPECT_EQ(device_->counters().bytes, 0u);
}

TEST_F(MemoryTest, MappingThatNobodyAskedForIsIgnored) {
  std::byte bytes[256];
  hooks_.answer.mapped = bytes;
  make(0, 1, &hooks_.hooks);
  ASSERT_EQ(bind(kLocal), Status::Ok);
  EXPECT_FALSE(hooks_.mustMap);
  EXPECT_EQ(buffers_[0].mapped, nullptr);
}

TEST_F(MemoryTest, DeviceLocalIsOptional) {
  mock_.memory.memoryTypes[0].propertyFlags = 0;
  make(1, 0);
  EXPECT_EQ(bind(kLocal), Status::Ok);
}

TEST_F(MemoryTest, NoCommonMemoryTypeIsUnsupported) {
  mock_.imageRequirements = {{1000, 256, 1}};
  mock_.bufferRequirements = {{100, 16, 2}};
  make(1, 1);
  EXPECT_EQ(bind(kLocal), Status::Unsupported);
  EXPECT_EQ(mock_.count("vkAllocateMemory"), 0);
  EXPECT_NE(mock_.lastDiagnostic().find("among the types 0x0"), std::string::npos);
}

TEST_F(MemoryTest, HostVisibleIsRequired) {
  mock_.memory.memoryTypes[1].propertyFlags = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT;
  make(0, 1);
  EXPECT_EQ(bind(kHost), Status::Unsupported);
}

TEST_F(MemoryTest, EmptyGroupIsRefused) {
  make(0, 0);
  EXPECT_EQ(bind(kLocal), Status::InvalidArgument);
}

TEST_F(MemoryTest, CopiedOnlyImageHasNoView) {
  make(0, 0);
  ImageDesc desc;
  desc.format = VK_FORMAT_R8G8B8A8_UNORM;
  desc.usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  Image image;
  ASSERT_EQ(createImage(*device_, desc, &image), Status::Ok);
  Image* pointer = &image;
  ASSERT_EQ(allocateAndBind(*device_, "block", kLocal, &pointer, 1, nullptr, 0, &block_),
            Status::Ok);
  EXPECT_EQ(image.view, handleFrom<VkImageView>(0));
  destroyImage(*device_, &image);
}

}  // namespace
}  // namespace alpenglow::engine
