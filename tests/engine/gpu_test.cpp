// The engine on a real driver: what shaders write is read back and compared.
#include <alpenglow/shaders/test_blur.h>
#include <alpenglow/shaders/test_gradient.h>
#include <alpenglow/shaders/test_pattern.h>
#include <alpenglow/shaders/test_triangle.h>

#include "engine/requirements.h"
#include "engine/sampler.h"
#include "engine/structure.h"
#include "tests/engine/counting_allocator.h"
#include "tests/engine/gpu_fixture.h"

namespace alpenglow::engine {
namespace {

using testing::ComputePass;
using testing::GpuTest;
using testing::halfToFloat;

constexpr Shader kPattern = {shaders::kTestPattern, sizeof(shaders::kTestPattern), "pattern"};
constexpr Shader kBlur = {shaders::kTestBlur, sizeof(shaders::kTestBlur), "blur"};
constexpr Shader kTriangle = {shaders::kTestTriangle, sizeof(shaders::kTestTriangle), "triangle"};
constexpr Shader kGradient = {shaders::kTestGradient, sizeof(shaders::kTestGradient), "gradient"};
constexpr VkFormat kHalf = VK_FORMAT_R16G16B16A16_SFLOAT;
constexpr VkFormat kFloat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr ImageState kColorTarget = {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                     VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                     VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};

TEST_F(GpuTest, ComputeWritesAStorageImageWithItsConstants) {
  Image& image = makeImage(20, 12, kHalf, "pattern");
  const ComputePass pass = makePass(kPattern, {&image}, {specFloat(0, 0.5f), specBool(1, true)});
  run([&](VkCommandBuffer commands) {
    Barriers barriers;
    barriers.image(image, kComputeWrite);
    if (barriers.record(engineDevice(), commands) != Status::Ok) return false;
    dispatch(commands, pass, image, 3.25f);
    copyBack(commands, image, 8);
    return !HasFatalFailure();
  });
  const auto texels = readback<uint16_t>(20 * 12 * 4);
  for (size_t y = 0; y < 12; ++y) {
    for (size_t x = 0; x < 20; ++x) {
      const uint16_t* texel = &texels[(y * 20 + x) * 4];
      EXPECT_EQ(halfToFloat(texel[0]), 0.5f * static_cast<float>(19 - x));
      EXPECT_EQ(halfToFloat(texel[1]), static_cast<float>(y));
      EXPECT_EQ(halfToFloat(texel[2]), 3.25f);
    }
  }
}

TEST_F(GpuTest, BarriersOrderAChainOfDispatches) {
  Image& first = makeImage(16, 16, kHalf, "first");
  Image& second = makeImage(16, 16, kHalf, "second");
  const ComputePass write = makePass(kPattern, {&first});
  const ComputePass forth = makePass(kBlur, {&first, &second});
  const ComputePass back = makePass(kBlur, {&second, &first});
  const ImageState read = {VK_IMAGE_LAYOUT_GENERAL, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                           VK_ACCESS_2_SHADER_STORAGE_READ_BIT};
  run([&](VkCommandBuffer commands) {
    Barriers barriers;
    const auto step = [&](const ComputePass& pass, Image* source, Image& target) {
      if (source != nullptr) barriers.image(*source, read);
      barriers.image(target, kComputeWrite);
      EXPECT_EQ(barriers.record(engineDevice(), commands), Status::Ok);
      dispatch(commands, pass, target, 1.0f);
    };
    step(write, nullptr, first);
    for (int i = 0; i < 3; ++i) {
      step(forth, &first, second);
      step(back, &second, first);
    }
    copyBack(commands, first, 8);
    return !HasFatalFailure();
  });
  const auto texels = readback<uint16_t>(16 * 16 * 4);
  // Six steps, each doubling.
  EXPECT_EQ(halfToFloat(texels[(3 * 16 + 5) * 4 + 0]), 64.0f * 5.0f);
  EXPECT_EQ(halfToFloat(texels[(3 * 16 + 5) * 4 + 1]), 64.0f * 3.0f);
  EXPECT_EQ(halfToFloat(texels[(15 * 16 + 15) * 4 + 2]), 64.0f);
}

/// Draws the gradient over a table that a compute shader fills.
class GraphicsTest : public GpuTest {
 protected:
  static constexpr uint32_t kSize = 32;

  void SetUp() override {
    GpuTest::SetUp();
    ASSERT_FALSE(HasFatalFailure());
    table_ = &makeImage(4, 4, kHalf, "table");
    target_ = &makeImage(kSize, kSize, kFloat, "target");
    fill_ = makePass(kPattern, {table_});
    const VkDescriptorSetLayoutBinding binding = {0, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1,
                                                  VK_SHADER_STAGE_FRAGMENT_BIT, nullptr};
    VkSampler sampler = VK_NULL_HANDLE;
    VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    const PoolPart part = {&binding, 1, 1};
    ASSERT_EQ(createSampler(engineDevice(), {}, &sampler), Status::Ok);
    ASSERT_EQ(createSetLayout(engineDevice(), &binding, 1, "draw", &setLayout), Status::Ok);
    ASSERT_EQ(createPool(engineDevice(), &part, 1, "draw", &pool), Status::Ok);
    ASSERT_EQ(allocateSets(engineDevice(), pool, &setLayout, 1, "draw", &set_), Status::Ok);
    ASSERT_EQ(createPipelineLayout(engineDevice(), &setLayout, 1, nullptr, 0, "draw", &layout_),
              Status::Ok);
    DescriptorWriter writer(set_);
    writer.sampledImage(0, table_->view, sampler);
    ASSERT_EQ(writer.flush(engineDevice()), Status::Ok);
    keep(VK_OBJECT_TYPE_PIPELINE_LAYOUT, handleNumber(layout_));
    keep(VK_OBJECT_TYPE_DESCRIPTOR_POOL, handleNumber(pool));
    keep(VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, handleNumber(setLayout));
    keep(VK_OBJECT_TYPE_SAMPLER, handleNumber(sampler));
  }

  GraphicsPipelineDesc pipelineDesc() const {
    GraphicsPipelineDesc desc;
    desc.vertex = kTriangle;
    desc.fragment = kGradient;
    desc.layout = layout_;
    desc.constants = &kDouble;
    desc.constantCount = 1;
    desc.colors[0].format = kFloat;
    return desc;
  }

  VkPipeline makePipeline(const GraphicsPipelineDesc& desc) {
    VkPipeline pipeline = VK_NULL_HANDLE;
    EXPECT_EQ(createGraphicsPipeline(engineDevice(), desc, &pipeline), Status::Ok)
        << lastDiagnostic();
    keep(VK_OBJECT_TYPE_PIPELINE, handleNumber(pipeline));
    return pipeline;
  }

  void fillTable(VkCommandBuffer commands, float push) {
    Barriers barriers;
    barriers.image(*table_, kComputeWrite);
    EXPECT_EQ(barriers.record(engineDevice(), commands), Status::Ok);
    dispatch(commands, fill_, *table_, push);
    barriers.image(*table_, kFragmentSampled);
    barriers.discard(*target_, kColorTarget);
    EXPECT_EQ(barriers.record(engineDevice(), commands), Status::Ok);
    EXPECT_EQ(assertLayout(engineDevice(), *table_, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL),
              Status::Ok);
  }

  void beginRendering(VkCommandBuffer commands, const Image* depth, float depthClear) {
    auto color = structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
    color.imageView = target_->view;
    color.imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
    color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    color.clearValue.color = {{-1.0f, -1.0f, -1.0f, -1.0f}};
    auto depthInfo =
        structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
    auto rendering = structure<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
    if (depth != nullptr) {
      depthInfo.imageView = depth->view;
      depthInfo.imageLayout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL;
      depthInfo.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
      depthInfo.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
      depthInfo.clearValue.depthStencil.depth = depthClear;
      rendering.pDepthAttachment = &depthInfo;
    }
    rendering.renderArea.extent = {kSize, kSize};
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachments = &color;
    vk().CmdBeginRendering(commands, &rendering);
  }

  void draw(VkCommandBuffer commands, VkPipeline pipeline) {
    const VkViewport viewport = {0, 0, kSize, kSize, 0, 1};
    const VkRect2D scissor = {{0, 0}, {kSize, kSize}};
    vk().CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    vk().CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_, 0, 1, &set_, 0,
                               nullptr);
    vk().CmdSetViewport(commands, 0, 1, &viewport);
    vk().CmdSetScissor(commands, 0, 1, &scissor);
    vk().CmdDraw(commands, 3, 1, 0, 0);
  }

  void expectGradient(float tableValue) {
    const auto texels = readback<float>(kSize * kSize * 4);
    for (size_t y = 0; y < kSize; ++y) {
      for (size_t x = 0; x < kSize; ++x) {
        const float* texel = &texels[(y * kSize + x) * 4];
        ASSERT_NEAR(texel[0], 2.0f * (static_cast<float>(x) + 0.5f) / kSize, 1e-5f);
        ASSERT_NEAR(texel[1], 2.0f * (static_cast<float>(y) + 0.5f) / kSize, 1e-5f);
        ASSERT_EQ(texel[2], tableValue);
      }
    }
  }

  static constexpr SpecConstant kDouble = {0, 0x40000000};  // 2.0f
  Image* table_ = nullptr;
  Image* target_ = nullptr;
  ComputePass fill_;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

TEST_F(GraphicsTest, DrawsWithDynamicRendering) {
  const VkPipeline pipeline = makePipeline(pipelineDesc());
  run([&](VkCommandBuffer commands) {
    fillTable(commands, 7.0f);
    beginRendering(commands, nullptr, 0.0f);
    draw(commands, pipeline);
    vk().CmdEndRendering(commands);
    copyBack(commands, *target_, 16);
    return !HasFatalFailure();
  });
  expectGradient(7.0f);
}

TEST_F(GraphicsTest, DepthTestComparesWithoutWriting) {
  Image& depth = makeImage(kSize, kSize, VK_FORMAT_D32_SFLOAT, "depth");
  GraphicsPipelineDesc desc = pipelineDesc();
  desc.depthFormat = VK_FORMAT_D32_SFLOAT;
  desc.depthTest = true;
  desc.depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;
  const VkPipeline pipeline = makePipeline(desc);
  const ImageState depthTarget = {
      VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
      VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
      VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
          VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
  for (const float clear : {0.0f, 0.5f}) {
    run([&](VkCommandBuffer commands) {
      fillTable(commands, 7.0f);
      Barriers barriers;
      barriers.discard(depth, depthTarget);
      EXPECT_EQ(barriers.record(engineDevice(), commands), Status::Ok);
      beginRendering(commands, &depth, clear);
      draw(commands, pipeline);
      vk().CmdEndRendering(commands);
      copyBack(commands, *target_, 16);
      return !HasFatalFailure();
    });
    // The triangle lies at depth 0: as near as 0, farther than 0.5 (reversed depth).
    EXPECT_EQ(readback<float>(4)[3], clear == 0.0f ? 1.0f : -1.0f);
  }
}

TEST_F(GraphicsTest, DrawsInARenderPassOfTheHost) {
  const VkDevice handle = device().device();
  VkAttachmentDescription attachment = {};
  attachment.format = kFloat;
  attachment.samples = VK_SAMPLE_COUNT_1_BIT;
  attachment.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  attachment.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  attachment.initialLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  attachment.finalLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL;
  const VkAttachmentReference reference = {0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL};
  VkSubpassDescription subpass = {};
  subpass.colorAttachmentCount = 1;
  subpass.pColorAttachments = &reference;
  auto passInfo = structure<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
  passInfo.attachmentCount = 1;
  passInfo.pAttachments = &attachment;
  passInfo.subpassCount = 1;
  passInfo.pSubpasses = &subpass;
#define HOST_FUNCTION(name) \
  const auto name = reinterpret_cast<PFN_vk##name>(device().function("vk" #name))
  HOST_FUNCTION(CreateRenderPass);
  HOST_FUNCTION(DestroyRenderPass);
  HOST_FUNCTION(CreateFramebuffer);
  HOST_FUNCTION(DestroyFramebuffer);
  HOST_FUNCTION(CmdBeginRenderPass);
  HOST_FUNCTION(CmdEndRenderPass);
#undef HOST_FUNCTION
  VkRenderPass renderPass = VK_NULL_HANDLE;
  ASSERT_EQ(CreateRenderPass(handle, &passInfo, nullptr, &renderPass), VK_SUCCESS);
  auto frameInfo = structure<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
  frameInfo.renderPass = renderPass;
  frameInfo.attachmentCount = 1;
  frameInfo.pAttachments = &target_->view;
  frameInfo.width = kSize;
  frameInfo.height = kSize;
  frameInfo.layers = 1;
  VkFramebuffer framebuffer = VK_NULL_HANDLE;
  ASSERT_EQ(CreateFramebuffer(handle, &frameInfo, nullptr, &framebuffer), VK_SUCCESS);

  GraphicsPipelineDesc desc = pipelineDesc();
  desc.renderPass = renderPass;
  const VkPipeline pipeline = makePipeline(desc);
  run([&](VkCommandBuffer commands) {
    fillTable(commands, 5.0f);
    VkClearValue clear = {};
    auto begin = structure<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    begin.renderPass = renderPass;
    begin.framebuffer = framebuffer;
    begin.renderArea.extent = {kSize, kSize};
    begin.clearValueCount = 1;
    begin.pClearValues = &clear;
    CmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
    draw(commands, pipeline);
    CmdEndRenderPass(commands);
    copyBack(commands, *target_, 16);
    return !HasFatalFailure();
  });
  expectGradient(5.0f);
  DestroyFramebuffer(handle, framebuffer, nullptr);
  DestroyRenderPass(handle, renderPass, nullptr);
}

TEST_F(GpuTest, DestructionWaitsForTheFrameThatUsesIt) {
  ImageDesc desc;
  desc.format = kHalf;
  desc.extent = {8, 8, 1};
  desc.usage = VK_IMAGE_USAGE_STORAGE_BIT;
  desc.name = "short-lived";
  Image image;
  Image* pointer = &image;
  MemoryBlock block;
  ASSERT_EQ(createImage(engineDevice(), desc, &image), Status::Ok);
  ASSERT_EQ(allocateAndBind(engineDevice(), "short-lived", VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT,
                            &pointer, 1, nullptr, 0, &block),
            Status::Ok);
  const ComputePass pass = makePass(kPattern, {&image});
  Counters& counters = engineDevice().counters();
  run([&](VkCommandBuffer commands) {
    Barriers barriers;
    barriers.image(image, kComputeWrite);
    EXPECT_EQ(barriers.record(engineDevice(), commands), Status::Ok);
    dispatch(commands, pass, image);
    // The owner lets go while the command buffer that uses it isn't even submitted. A collect now
    // must leave it alone, or validation reports a destroyed object in the command buffer.
    deferImage(engineDevice(), device().frame(), &image);
    deferBlock(engineDevice(), device().frame(), &block);
    engineDevice().deletions().collect(device().frame() - 1);
    EXPECT_EQ(counters.images, 1u);
    return true;
  });
  engineDevice().deletions().collect(device().frame() - 1);
  EXPECT_EQ(counters.images, 0u);
  EXPECT_EQ(counters.bytes, 0u);
}

TEST_F(GpuTest, OneBlockHoldsMappedBuffersOfSeveralAlignments) {
  Buffer uniform;
  Buffer storage;
  Buffer* const buffers[] = {&uniform, &storage};
  MemoryBlock block;
  ASSERT_EQ(createBuffer(engineDevice(), 20,
                         VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                         "uniform", &uniform),
            Status::Ok);
  ASSERT_EQ(createBuffer(engineDevice(), 20,
                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                         "storage", &storage),
            Status::Ok);
  ASSERT_EQ(
      allocateAndBind(engineDevice(), "constants",
                      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                      nullptr, 0, buffers, 2, &block),
      Status::Ok);
  ASSERT_NE(uniform.mapped, nullptr);
  std::memcpy(uniform.mapped, "alpenglow", 10);
  std::memset(storage.mapped, 0, 20);
  run([&](VkCommandBuffer commands) {
    const VkBufferCopy region = {0, 4, 10};
    vk().CmdCopyBuffer(commands, uniform.handle, storage.handle, 1, &region);
    Barriers barriers;
    barriers.memory(VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                    VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    return barriers.record(engineDevice(), commands) == Status::Ok;
  });
  EXPECT_STREQ(static_cast<const char*>(storage.mapped) + 4, "alpenglow");
  destroyBuffer(engineDevice(), &uniform);
  destroyBuffer(engineDevice(), &storage);
  freeBlock(engineDevice(), &block);
}

TEST_F(GpuTest, AllocationCallbacksArePaired) {
  testing::CountingAllocator allocator;
  DeviceDesc desc = alpenglow::testing::deviceDesc(contextDesc());
  desc.allocator = allocator.callbacks();
  engine::Device* counted = nullptr;
  ASSERT_EQ(engine::Device::create(desc, &counted), Status::Ok);
  Buffer buffer;
  Buffer* pointer = &buffer;
  MemoryBlock block;
  VkSampler sampler = VK_NULL_HANDLE;
  ASSERT_EQ(createBuffer(*counted, 64, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, "b", &buffer),
            Status::Ok);
  ASSERT_EQ(allocateAndBind(*counted, "b", VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, nullptr, 0,
                            &pointer, 1, &block),
            Status::Ok);
  ASSERT_EQ(createSampler(*counted, {}, &sampler), Status::Ok);
  EXPECT_GE(allocator.alive, 3);
  counted->destroyObject(VK_OBJECT_TYPE_SAMPLER, sampler);
  destroyBuffer(*counted, &buffer);
  freeBlock(*counted, &block);
  engine::Device::destroy(counted);
  EXPECT_EQ(allocator.alive, 0);
}

TEST_F(GpuTest, HostMemoryHookServesImages) {
  struct Pool {
    headless::Device& device;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    int freed = 0;
  } pool{device()};
  MemoryHooks hooks;
  hooks.user = &pool;
  hooks.allocate = [](void* user, const VkMemoryRequirements& requirements, uint32_t type, bool,
                      const char*, MemoryRange* range) {
    Pool& self = *static_cast<Pool*>(user);
    const auto allocate =
        reinterpret_cast<PFN_vkAllocateMemory>(self.device.function("vkAllocateMemory"));
    auto info = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = requirements.size + requirements.alignment;
    info.memoryTypeIndex = type;
    range->offset = requirements.alignment;
    const VkResult result = allocate(self.device.device(), &info, nullptr, &range->memory);
    self.memory = range->memory;
    return result;
  };
  hooks.free = [](void* user, const MemoryRange&) { ++static_cast<Pool*>(user)->freed; };
  DeviceDesc desc = alpenglow::testing::deviceDesc(contextDesc());
  desc.memory = &hooks;
  engine::Device* hooked = nullptr;
  ASSERT_EQ(engine::Device::create(desc, &hooked), Status::Ok);
  hooks = {};  // They were copied.
  ImageDesc imageDesc;
  imageDesc.format = kHalf;
  imageDesc.extent = {8, 8, 8};
  imageDesc.type = VK_IMAGE_TYPE_3D;
  imageDesc.usage = VK_IMAGE_USAGE_STORAGE_BIT;
  Image image;
  Image* pointer = &image;
  MemoryBlock block;
  ASSERT_EQ(createImage(*hooked, imageDesc, &image), Status::Ok);
  ASSERT_EQ(allocateAndBind(*hooked, "3D", VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, &pointer, 1,
                            nullptr, 0, &block),
            Status::Ok);
  destroyImage(*hooked, &image);
  freeBlock(*hooked, &block);
  EXPECT_EQ(pool.freed, 1);
  engine::Device::destroy(hooked);
  reinterpret_cast<PFN_vkFreeMemory>(device().function("vkFreeMemory"))(device().device(),
                                                                        pool.memory, nullptr);
}

TEST_F(GpuTest, ImpossibleImagesAreRefusedBeforeVulkanIsCalled) {
  ImageDesc desc;
  desc.format = kHalf;
  desc.usage = VK_IMAGE_USAGE_STORAGE_BIT;
  desc.name = "huge";
  desc.extent = {1u << 20, 1, 1};
  Image image;
  EXPECT_EQ(createImage(engineDevice(), desc, &image), Status::Unsupported);
  EXPECT_NE(lastDiagnostic().find("\"huge\" has 1048576x1x1 texels"), std::string::npos)
      << lastDiagnostic();
  desc.extent = {16, 16, 1};
  desc.format = VK_FORMAT_D32_SFLOAT;
  EXPECT_EQ(createImage(engineDevice(), desc, &image), Status::Unsupported);
  EXPECT_NE(lastDiagnostic().find("for storage images"), std::string::npos) << lastDiagnostic();
}

TEST_F(GpuTest, RequirementsOfThisDevice) {
  FeatureSet needed = alpenglow::testing::featureSet(device().enabled());
  std::string missing;
  const auto check = [&] {
    return checkPhysicalDevice(
        device().getInstanceProcAddr(), device().instance(), device().physicalDevice(), needed,
        [](void* user, const Diagnostic& diagnostic) {
          *static_cast<std::string*>(user) = diagnostic.message;
        },
        &missing);
  };
  EXPECT_EQ(check(), Status::Ok);
  needed.apiVersion = VK_MAKE_API_VERSION(0, 9, 0, 0);
  EXPECT_EQ(check(), Status::Unsupported);
  EXPECT_NE(missing.find("Vulkan 9.0"), std::string::npos) << missing;
  EXPECT_NE(missing.find(device().name()), std::string::npos) << missing;
}

}  // namespace
}  // namespace alpenglow::engine
