#include "tests/passes/sky/aerial_perspective_fixture.h"

#include <alpenglow/shaders/test_aerial_perspective_lookup.h>

#include <algorithm>

#include "atmosphere/api/context_impl.h"
#include "engine/pipeline.h"

namespace alpenglow::testing {
namespace {

constexpr VkShaderStageFlags kStages = VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
constexpr VkDescriptorSetLayoutBinding image(uint32_t i) {
  return {i, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, kStages, nullptr};
}
constexpr VkDescriptorSetLayoutBinding kImages[] = {image(0), image(1), image(2)};
constexpr VkDescriptorSetLayoutBinding kBuffers[] = {
    {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
    {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};
constexpr uint32_t kMostQueries = 1u << 16;

struct Objects {
  engine::Device* device = nullptr;
  std::unique_ptr<passes::AerialPerspectiveLut> volume;
  VkDescriptorSetLayout imageLayout = VK_NULL_HANDLE, bufferLayout = VK_NULL_HANDLE;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  VkDescriptorSet images = VK_NULL_HANDLE, buffers = VK_NULL_HANDLE;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipelines[4] = {};  ///< By AerialAsk.
  headless::HostBuffer queries, answers;
};

Objects& objects() {
  static Objects instance;
  return instance;
}

}  // namespace

void AerialPerspectiveTest::TearDownTestSuite() {
  Objects& o = objects();
  if (o.device != nullptr) {
    const engine::Dispatch& vk = o.device->vk();
    const VkDevice handle = o.device->handle();
    if (o.volume != nullptr) o.volume->destroy(0);  // The device has finished with it.
    o.volume.reset();
    o.device->deletions().collect(o.device->completed());
    for (VkPipeline pipeline : o.pipelines)
      vk.DestroyPipeline(handle, pipeline, o.device->allocator());
    vk.DestroyPipelineLayout(handle, o.layout, o.device->allocator());
    vk.DestroyDescriptorPool(handle, o.pool, o.device->allocator());
    vk.DestroyDescriptorSetLayout(handle, o.imageLayout, o.device->allocator());
    vk.DestroyDescriptorSetLayout(handle, o.bufferLayout, o.device->allocator());
  }
  o = Objects{};
  SkyTest::TearDownTestSuite();
}

void AerialPerspectiveTest::makeObjects() {
  Objects& o = objects();
  if (o.device != nullptr) return;
  tables::Resources& resources = *context()->bake;
  engine::Device& d = resources.device();
  o.device = &d;
  o.volume = std::make_unique<passes::AerialPerspectiveLut>(resources);
  ASSERT_EQ(o.volume->make(0, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT), Status::Ok) << message();
  ASSERT_EQ(engine::createSetLayout(d, kImages, 3, "air images", &o.imageLayout), Status::Ok);
  ASSERT_EQ(engine::createSetLayout(d, kBuffers, 2, "air buffers", &o.bufferLayout), Status::Ok);
  const engine::PoolPart parts[] = {{kImages, 3, 1}, {kBuffers, 2, 1}};
  ASSERT_EQ(engine::createPool(d, parts, 2, "air", &o.pool), Status::Ok);
  ASSERT_EQ(engine::allocateSets(d, o.pool, &o.imageLayout, 1, "air", &o.images), Status::Ok);
  ASSERT_EQ(engine::allocateSets(d, o.pool, &o.bufferLayout, 1, "air", &o.buffers), Status::Ok);
  const VkDescriptorSetLayout sets[] = {resources.tableLayout(), o.imageLayout, o.bufferLayout};
  const VkPushConstantRange range = {VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof(LookupConstants)};
  ASSERT_EQ(engine::createPipelineLayout(d, sets, 3, &range, 1, "air", &o.layout), Status::Ok);
  engine::ComputePipelineDesc desc;
  desc.shader = {shaders::kTestAerialPerspectiveLookup,
                 sizeof shaders::kTestAerialPerspectiveLookup, "aerial_perspective_lookup.comp"};
  desc.layout = o.layout;
  for (uint32_t what = 0; what < 4; ++what) {
    const engine::SpecConstant constant = engine::specUint(0, what);
    desc.constants = &constant;
    desc.constantCount = 1;
    ASSERT_EQ(engine::createComputePipeline(d, desc, &o.pipelines[what]), Status::Ok) << message();
  }

  std::string error;
  o.queries = device().createHostBuffer(kMostQueries * sizeof(AerialQuery),
                                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &error);
  o.answers = device().createHostBuffer(kMostQueries * sizeof(AerialAnswer),
                                        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &error);
  ASSERT_TRUE(error.empty()) << error;
  engine::DescriptorWriter images(o.images);
  for (uint32_t i = 0; i < 3; ++i)
    images.sampledImage(i, o.volume->image(i).view, resources.sampler());
  ASSERT_EQ(images.flush(d), Status::Ok);
  engine::DescriptorWriter buffers(o.buffers);
  buffers.storageBuffer(0, o.queries.buffer()).storageBuffer(1, o.answers.buffer());
  ASSERT_EQ(buffers.flush(d), Status::Ok);
}

passes::AerialPerspectiveLut* AerialPerspectiveTest::volume() {
  makeObjects();
  return objects().volume.get();
}

void AerialPerspectiveTest::fill(const FrameState& draw, Tables* with) {
  Tables* const baked = with != nullptr ? with : tables();
  passes::AerialPerspectiveLut* const filled = volume();
  run([&](VkCommandBuffer commands) {
    return filled->record(commands, *baked, draw) == Status::Ok;
  });
}

LookupConstants AerialPerspectiveTest::lookupConstants(const Parameters& parameters,
                                                       const FrameState& draw) {
  const passes::AerialPerspectiveLookup lookup = passes::aerialPerspectiveLookup(parameters, draw);
  const auto f = [](double value) { return static_cast<float>(value); };
  LookupConstants k = {};
  for (size_t i = 0; i < 3; ++i) {
    k.up[i] = f(lookup.up[i]);
    k.sun[i] = f(draw.sun.direction[i]);
    k.azimuth[i] = f(lookup.sunAzimuth[i]);
  }
  k.altitude = f(passes::cameraAltitude(parameters, draw.camera));
  k.horizon = f(lookup.view.skyView.horizon);
  k.span = f(lookup.view.skyView.span);
  k.bend = f(lookup.view.skyView.bend);
  k.extinction = f(lookup.view.extinction_);
  k.startHeight = f(lookup.view.startHeight);
  k.height = f(lookup.view.height);
  return k;
}

bool AerialPerspectiveTest::recordAsk(VkCommandBuffer commands, const FrameState& draw,
                                      AerialAsk what, size_t count, Tables* baked) {
  Objects& o = objects();
  LookupConstants constants = lookupConstants(baked->parameters(), draw);
  constants.count = static_cast<float>(count);
  const engine::Dispatch& vk = o.device->vk();
  const VkDescriptorSet sets[] = {baked->descriptorSet(), o.images, o.buffers};
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                     o.pipelines[static_cast<uint32_t>(what)]);
  vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, o.layout, 0, 3, sets, 0,
                           nullptr);
  vk.CmdPushConstants(commands, o.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants,
                      &constants);
  vk.CmdDispatch(commands, (static_cast<uint32_t>(count) + 63) / 64, 1, 1);
  engine::Barriers barriers;
  barriers.memory(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                  VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
  return barriers.record(*o.device, commands) == Status::Ok;
}

std::vector<AerialAnswer> AerialPerspectiveTest::ask(const FrameState& draw,
                                                     const std::vector<AerialQuery>& queries,
                                                     Tables* with) {
  Tables* const baked = with != nullptr ? with : tables();
  makeObjects();
  Objects& o = objects();
  EXPECT_LE(queries.size(), kMostQueries);
  EXPECT_TRUE(o.volume->current(*baked, draw));
  EXPECT_EQ(o.volume->lut().assertReadable(), Status::Ok);
  std::copy(queries.begin(), queries.end(), static_cast<AerialQuery*>(o.queries.data()));
  run([&](VkCommandBuffer commands) {
    return recordAsk(commands, draw, AerialAsk::All, queries.size(), baked);
  });
  const auto* answers = static_cast<const AerialAnswer*>(o.answers.data());
  return {answers, answers + queries.size()};
}

double AerialPerspectiveTest::leastSeconds(const std::function<bool(VkCommandBuffer)>& record) {
  double best = 1e30;
  for (int i = -1; i < 5; ++i) {  // the first compiles
    double seconds = 0.0;
    int count = 0;
    for (; seconds < 0.1 && count < 60 && !HasFailure(); ++count) {
      headless::Timing timing;
      std::string error;
      EXPECT_TRUE(device().run(record, &error, &timing)) << error << message();
      seconds += timing.cpuSeconds;
    }
    if (i >= 0) best = std::min(best, seconds / std::max(count, 1));
  }
  return best;
}

double AerialPerspectiveTest::askSeconds(const FrameState& draw, AerialAsk what,
                                         const std::vector<AerialQuery>& queries) {
  makeObjects();
  std::copy(queries.begin(), queries.end(), static_cast<AerialQuery*>(objects().queries.data()));
  Tables* const baked = tables();
  return leastSeconds([&](VkCommandBuffer commands) {
    return recordAsk(commands, draw, what, queries.size(), baked);
  });
}

double AerialPerspectiveTest::fillSeconds(const FrameState& draw) {
  passes::AerialPerspectiveLut* const filled = volume();
  Tables* const baked = tables();
  // Nothing is recorded twice for the same draw.
  FrameState draws[2] = {draw, draw};
  for (double& x : draws[1].camera.position_m) x *= 1.0 + 1e-6;
  size_t next = 0;
  return leastSeconds([&](VkCommandBuffer commands) {
    next = 1 - next;
    EXPECT_FALSE(filled->current(*baked, draws[next]));
    return filled->record(commands, *baked, draws[next]) == Status::Ok;
  });
}

}  // namespace alpenglow::testing
