// Tests of the validation layers: each test makes an error and must get a message. Otherwise silent
// layers would look like success.
#include <alpenglow/shaders/test_blur.h>
#include <alpenglow/shaders/test_pattern.h>
#include <gtest/gtest-spi.h>

#include <cstddef>

#include "engine/sampler.h"
#include "tests/engine/gpu_fixture.h"

namespace alpenglow::engine {
namespace {

using testing::ComputePass;
using testing::DeviceTest;
using testing::GpuTest;

constexpr Shader kPattern = {shaders::kTestPattern, sizeof(shaders::kTestPattern), "pattern"};
constexpr Shader kBlur = {shaders::kTestBlur, sizeof(shaders::kTestBlur), "blur"};
constexpr VkFormat kHalf = VK_FORMAT_R16G16B16A16_SFLOAT;

class NetTest : public GpuTest {
 protected:
  /// A dispatch reads what another has just written; with or without a barrier between.
  void writeThenRead(bool withBarrier) {
    Image& first = makeImage(8, 8, kHalf, "a table of ours");
    Image& second = makeImage(8, 8, kHalf, "second");
    const ComputePass write = makePass(kPattern, {&first});
    const ComputePass read = makePass(kBlur, {&first, &second});
    run([&](VkCommandBuffer commands) {
      Barriers barriers;
      barriers.image(first, kComputeWrite);
      barriers.image(second, kComputeWrite);
      EXPECT_EQ(barriers.record(engineDevice(), commands), Status::Ok);
      dispatch(commands, write, first);
      if (withBarrier) {
        barriers.image(first, kComputeReadWrite);
        EXPECT_EQ(barriers.record(engineDevice(), commands), Status::Ok);
      }
      dispatch(commands, read, second);
      return true;
    });
  }
};

TEST_F(NetTest, MissingBarrierIsAHazardOfANamedImage) {
  expectMessage("SYNC-HAZARD-READ-AFTER-WRITE");
  writeThenRead(false);
}

TEST_F(NetTest, TheSameWithABarrierIsSilent) { writeThenRead(true); }

TEST_F(NetTest, ObjectsCarryTheirNames) {
  expectMessage("a table of ours");
  writeThenRead(false);
}

TEST_F(NetTest, WrongLayoutIsReported) {
  expectMessage("VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL");  // At the submit.
  expectMessage("VUID-vkCmdDispatch-None-02699");
  expectMessage("SYNC-HAZARD-WRITE-AFTER-WRITE");  // The write isn't what the barrier was for.
  Image& image = makeImage(8, 8, kHalf, "image");
  const ComputePass pass = makePass(kPattern, {&image});
  run([&](VkCommandBuffer commands) {
    Barriers barriers;
    barriers.image(image, kComputeSampled);  // The descriptor says GENERAL.
    EXPECT_EQ(barriers.record(engineDevice(), commands), Status::Ok);
    // Our own check, which also covers attachments, hears of it first.
    EXPECT_EQ(assertLayout(engineDevice(), image, VK_IMAGE_LAYOUT_GENERAL),
              Status::InvalidArgument);
    dispatch(commands, pass, image);
    return true;
  });
}

TEST_F(NetTest, CopyOutOfBoundsIsReported) {
  expectMessage("VUID-vkCmdCopyBuffer-size-00115");
  std::string error;
  const headless::HostBuffer source =
      device().createHostBuffer(64, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, &error);
  const headless::HostBuffer target =
      device().createHostBuffer(128, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &error);
  // Recorded only: to run it would write what isn't ours.
  const bool submitted = device().run(
      [&](VkCommandBuffer commands) {
        const VkBufferCopy region = {0, 0, 65};
        vk().CmdCopyBuffer(commands, source.buffer(), target.buffer(), 1, &region);
        return false;
      },
      nullptr);
  EXPECT_FALSE(submitted);
}

/// Host memory that is all given back at the end, whatever the driver leaves behind.
class Arena {
 public:
  Arena() {
    callbacks_.pUserData = this;
    callbacks_.pfnAllocation = [](void* user, size_t size, size_t, VkSystemAllocationScope) {
      return static_cast<void*>(static_cast<Arena*>(user)
                                    ->blocks_
                                    .emplace_back(std::make_unique<std::max_align_t[]>(
                                        size / sizeof(std::max_align_t) + 1))
                                    .get());
    };
    callbacks_.pfnReallocation = [](void*, void*, size_t, size_t,
                                    VkSystemAllocationScope) -> void* { return nullptr; };
    callbacks_.pfnFree = [](void*, void*) {};
  }
  const VkAllocationCallbacks* callbacks() const { return &callbacks_; }

 private:
  VkAllocationCallbacks callbacks_ = {};
  std::vector<std::unique_ptr<std::max_align_t[]>> blocks_;
};

TEST_F(NetTest, ObjectThatOutlivesItsDeviceIsReported) {
  expectMessage("VUID-vkDestroyDevice-device-00378");
  const Arena arena;
  std::unique_ptr<headless::Device> other = makeDevice();
  ASSERT_NE(other, nullptr);
  engine::DeviceDesc desc = alpenglow::testing::deviceDesc(other->contextDesc());
  desc.allocator = arena.callbacks();
  desc.debugNames = false;  // The driver would keep the name.
  engine::Device* context = nullptr;
  ASSERT_EQ(engine::Device::create(desc, &context), Status::Ok);
  VkSampler leaked = VK_NULL_HANDLE;
  ASSERT_EQ(createSampler(*context, {}, &leaked), Status::Ok);
  engine::Device::destroy(context);
  other.reset();
}

/// The fixture itself: its TearDown is called by hand and must fail.
class FixtureTest : public DeviceTest {
 protected:
  void provoke() {
    engine::Device* context = nullptr;
    ASSERT_EQ(engine::Device::create(alpenglow::testing::deviceDesc(contextDesc()), &context),
              Status::Ok);
    const VkDescriptorSetLayoutBinding twice[] = {
        {0, VK_DESCRIPTOR_TYPE_SAMPLER, 1, VK_SHADER_STAGE_ALL, nullptr},
        {0, VK_DESCRIPTOR_TYPE_SAMPLER, 1, VK_SHADER_STAGE_ALL, nullptr}};
    VkDescriptorSetLayout layout = VK_NULL_HANDLE;
    if (createSetLayout(*context, twice, 2, "twice", &layout) == Status::Ok) {
      context->destroyObject(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, layout);
    }
    engine::Device::destroy(context);
  }
};

TEST_F(FixtureTest, AMessageThatNobodyExpectsFailsTheTest) {
  provoke();
  EXPECT_NONFATAL_FAILURE(TearDown(), "Validation: ");
}

TEST_F(FixtureTest, SilenceWhereAMessageIsExpectedFailsTheTest) {
  class Expecting : public DeviceTest {
   public:
    void TestBody() override {}
    void expectInVain() {
      expectMessage("the moon is made of cheese");
      TearDown();
    }
  } expecting;
  EXPECT_NONFATAL_FAILURE(expecting.expectInVain(), "the moon is made of cheese");
}

}  // namespace
}  // namespace alpenglow::engine
