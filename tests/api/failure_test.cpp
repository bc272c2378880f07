// Every Vulkan call of the library that can fail is made to fail, one after the other, from the
// context to a probe: the status is the documented one, a sentence names what happened, and nothing
// stays behind. What stays, validation reports when the device goes.
#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

/// All that a host makes. Every step is undone by the destructor, also after a failure.
struct Host {
  Context* context = nullptr;
  Tables* tables = nullptr;
  View* view = nullptr;
  bool nullAfterFailure = true;

  ~Host() {
    destroyView(view);
    destroyTables(tables);
    destroyContext(context);
  }

  Status make(const ContextDesc& desc) {
    Status status = createContext(desc, &context);
    if (status != Status::Ok) return keep(status, context == nullptr);
    TableDesc tiny;
    tiny.solver = Solver::Standard;
    tiny.orders = 2;
    tiny.sizes = {.transmittanceMu = 4,
                  .transmittanceR = 4,
                  .irradianceMuS = 4,
                  .irradianceR = 2,
                  .scatteringR = 2,
                  .scatteringMu = 4,
                  .scatteringMuS = 4,
                  .scatteringNu = 2};
    status = createTables(context, preset("earth"), tiny, &tables);
    if (status != Status::Ok) return keep(status, tables == nullptr && empty());
    ViewDesc viewDesc;
    viewDesc.sky = SkyMethod::Integrate;
    viewDesc.colorFormat = VK_FORMAT_R16G16B16A16_SFLOAT;
    status = createView(context, tables, viewDesc, &view);
    return status == Status::Ok ? status : keep(status, view == nullptr);
  }

  /// Nothing of the context's memory is alive.
  bool empty() const {
    ResourceReport report;
    resourceReport(context, &report);
    return report.bytes + report.images + report.buffers == 0;
  }

 private:
  Status keep(Status status, bool asPromised) {
    nullAfterFailure = asPromised;
    return status;
  }
};

struct Outcome {
  VkResult result;
  Status status;
  const char* name;
};

TEST_F(StandardSkyTest, EveryFailingCallIsReportedAndLeavesNothing) {
  VulkanWrap wrap(device().getInstanceProcAddr());
  ContextDesc desc = contextDesc();
  desc.getInstanceProcAddr = wrap.getInstanceProcAddr();
  const Outcome outcomes[] = {
      {VK_ERROR_OUT_OF_DEVICE_MEMORY, Status::OutOfDeviceMemory, "VK_ERROR_OUT_OF_DEVICE_MEMORY"},
      {VK_ERROR_OUT_OF_HOST_MEMORY, Status::OutOfHostMemory, "VK_ERROR_OUT_OF_HOST_MEMORY"},
      {VK_ERROR_DEVICE_LOST, Status::DeviceLost, "VK_ERROR_DEVICE_LOST"}};
  std::map<std::string, int> failed;
  bool succeeded = false;
  for (int n = 0; n < 1000 && !succeeded; ++n) {
    const Outcome& outcome = outcomes[n % 3];
    wrap.fallibleCalls = 0;
    wrap.failedCall.clear();
    wrap.failAt = n;
    wrap.failWith = outcome.result;
    const size_t said = diagnostics().size();
    Host host;
    const Status status = host.make(desc);
    succeeded = status == Status::Ok && wrap.failedCall.empty();
    if (succeeded) break;
    ++failed[wrap.failedCall];
    EXPECT_EQ(status, outcome.status) << wrap.failedCall << ", call " << n;
    EXPECT_EQ(diagnostics().size(), said + 1) << wrap.failedCall;
    EXPECT_NE(lastDiagnostic().find(outcome.name), std::string::npos) << lastDiagnostic();
    EXPECT_TRUE(host.nullAfterFailure) << wrap.failedCall << ", call " << n;
  }
  EXPECT_TRUE(succeeded);
  for (const char* name :
       {"vkAllocateDescriptorSets", "vkAllocateMemory", "vkBindBufferMemory", "vkBindImageMemory",
        "vkCreateBuffer", "vkCreateComputePipelines", "vkCreateDescriptorPool",
        "vkCreateDescriptorSetLayout", "vkCreateGraphicsPipelines", "vkCreateImage",
        "vkCreateImageView", "vkCreatePipelineLayout", "vkCreateSampler", "vkCreateShaderModule",
        "vkMapMemory"}) {
    EXPECT_GT(failed[name], 0) << name;
  }
}

// A probe makes objects while it records; when that fails the tables are as they were.
TEST_F(StandardSkyTest, FailingProbesLeaveTheTablesReady) {
  const std::vector<double> before = [&] {
    const ProbeAnswer answer = probeAll({ProbeQuery{}}).at(0);
    return std::vector<double>(answer.skyRadiance.value, answer.skyRadiance.value + 3);
  }();
  const headless::HostBuffer answers =
      device().createHostBuffer(kProbeAnswerBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, nullptr);
  ResourceReport start, end;
  finishFrames(context());
  resourceReport(context(), &start);
  bool succeeded = false;
  int n = 0;
  for (; n < 20 && !succeeded; ++n) {
    vulkan().fallibleCalls = 0;
    vulkan().failAt = n;
    run([&](VkCommandBuffer commands) {
      const ProbeQuery query;
      const Status status = recordProbe(tables(), commands, &query, 1, answers.buffer());
      succeeded = status == Status::Ok;
      if (!succeeded) {
        EXPECT_EQ(status, Status::OutOfDeviceMemory) << message();
      }
      return true;
    });
    finishFrames(context());
    resourceReport(context(), &end);
    EXPECT_EQ(end.bytes, start.bytes) << n;
    EXPECT_EQ(end.buffers, start.buffers) << n;
  }
  vulkan().failAt = -1;
  EXPECT_TRUE(succeeded);
  EXPECT_GT(n, 4);
  EXPECT_TRUE(ready(tables()));
  EXPECT_EQ(probeAll({ProbeQuery{}}).at(0).skyRadiance[1], before[1]);
}

}  // namespace
}  // namespace alpenglow::testing
