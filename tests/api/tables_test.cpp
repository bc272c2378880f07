// What tables say of themselves, and what this version refuses.
#include <cstring>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

/// The stages that layout changes of images led to, of the last vkCmdPipelineBarrier2 with any.
VkPipelineStageFlags2 readersOfLastBarrier = 0;
PFN_vkGetInstanceProcAddr realInstanceProc = nullptr;
PFN_vkGetDeviceProcAddr realDeviceProc = nullptr;
PFN_vkCmdPipelineBarrier2 realBarrier = nullptr;

VKAPI_ATTR void VKAPI_CALL watchedBarrier(VkCommandBuffer commands, const VkDependencyInfo* info) {
  if (info->imageMemoryBarrierCount > 0) readersOfLastBarrier = 0;
  for (uint32_t i = 0; i < info->imageMemoryBarrierCount; ++i)
    readersOfLastBarrier |= info->pImageMemoryBarriers[i].dstStageMask;
  realBarrier(commands, info);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL watchedDeviceProc(VkDevice device, const char* name) {
  const PFN_vkVoidFunction real = realDeviceProc(device, name);
  if (std::strcmp(name, "vkCmdPipelineBarrier2") != 0) return real;
  realBarrier = reinterpret_cast<PFN_vkCmdPipelineBarrier2>(real);
  return reinterpret_cast<PFN_vkVoidFunction>(watchedBarrier);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL watchedInstanceProc(VkInstance instance,
                                                             const char* name) {
  const PFN_vkVoidFunction real = realInstanceProc(instance, name);
  if (std::strcmp(name, "vkGetDeviceProcAddr") != 0) return real;
  realDeviceProc = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
  return reinterpret_cast<PFN_vkVoidFunction>(watchedDeviceProc);
}

class TablesTest : public SkyTest {
 protected:
  Tables* make(const TableDesc& desc) {
    Tables* made = nullptr;
    EXPECT_EQ(createTables(context(), preset("earth"), desc, &made), Status::Ok) << message();
    return made;
  }

  /// By createTables and by resolveTableDesc, in the same words, without a change.
  void expectRefused(const TableDesc& desc, Status status, const char* parts) {
    message().clear();
    Tables* made = reinterpret_cast<Tables*>(uintptr_t{1});
    EXPECT_EQ(createTables(context(), preset("earth"), desc, &made), status) << parts;
    EXPECT_EQ(made, nullptr);
    EXPECT_TRUE(hasAll(message(), parts)) << message();
    std::string said;
    const DiagnosticSink sink = {[](void* user, const Diagnostic& diagnostic) {
                                   *static_cast<std::string*>(user) += diagnostic.message;
                                 },
                                 &said};
    TableDesc same = desc;
    EXPECT_EQ(resolveTableDesc(preset("earth"), &same, sink), status) << parts;
    EXPECT_EQ(said, message());
    EXPECT_EQ(same.wavelengthCount, desc.wavelengthCount);
    EXPECT_EQ(same.sizes.degree, desc.sizes.degree);
  }
  void expectUnsupported(const TableDesc& desc, const char* parts) {
    expectRefused(desc, Status::Unsupported, parts);
  }

  static bool sameDesc(const TableDesc& a, const TableDesc& b) {
    bool same = a.solver == b.solver && a.quality == b.quality && a.orders == b.orders &&
                a.format == b.format && a.mie == b.mie && a.wavelengthCount == b.wavelengthCount &&
                std::memcmp(&a.sizes, &b.sizes, sizeof a.sizes) == 0 &&
                a.disabledEffects == b.disabledEffects && a.sunZenithFrom == b.sunZenithFrom &&
                a.sunZenithTo == b.sunZenithTo && a.cpuQueries == b.cpuQueries &&
                a.keepOrders == b.keepOrders && a.readerStages == b.readerStages;
    for (uint32_t i = 0; i < kMaxLights; ++i)
      same = same && a.lights[i].kind == b.lights[i].kind &&
             std::memcmp(&a.lights[i].irradiance, &b.lights[i].irradiance, sizeof(Spectrum)) == 0;
    return same;
  }
};

TEST_F(TablesTest, WhatIsOfLaterVersionsIsRefusedByName) {
  TableDesc desc;
  desc.wavelengthCount = 4;
  expectUnsupported(desc, "TableDesc::wavelengthCount is 4");
  desc = {};
  desc.wavelengths_nm[2] = 550.0;
  expectUnsupported(desc, "TableDesc::wavelengths_nm[2] is 550");
  desc = {};
  desc.lights[0].kind = LightKind::Moon;
  expectUnsupported(desc, "TableDesc::lights[0].kind is LightKind::Moon");
  desc.lights[0].kind = LightKind::None;
  expectUnsupported(desc, "TableDesc::lights[0].kind is LightKind::None");
  desc = {};
  desc.lights[3].kind = LightKind::Star;
  expectUnsupported(desc, "TableDesc::lights[3].kind is LightKind::Star");
  desc = {};
  desc.lights[1].irradiance[1] = 1.0;
  expectUnsupported(desc, "TableDesc::lights[1].irradiance");
  desc = {};
  desc.readerStages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_HOST_BIT;
  expectUnsupported(desc, "TableDesc::readerStages has the bits 0x4000");
  desc = {};
  desc.solver = Solver::Standard;
  desc.cpuQueries = CpuQueries::Light;
  expectUnsupported(desc, "TableDesc::cpuQueries|Solver::Standard");
}

TEST_F(TablesTest, WrongValuesAreRefusedByName) {
  const auto expectInvalid = [&](const TableDesc& desc, const char* parts) {
    expectRefused(desc, Status::InvalidArgument, parts);
  };
  TableDesc desc;
  desc.cpuQueries = static_cast<CpuQueries>(3);
  expectInvalid(desc, "cpuQueries 3");
  desc = {};
  desc.lights[1].kind = static_cast<LightKind>(7);
  expectInvalid(desc, "TableDesc::lights[1].kind is 7");
  desc = {};
  desc.lights[0].irradiance[2] = -2.0;
  expectInvalid(desc, "TableDesc::lights[0].irradiance|-2");
  desc = {};
  desc.sizes.transmittanceMu = 32;
  expectInvalid(desc, "Solver::Moments|TableSizes::transmittanceMu");
  desc = {};
  desc.sizes.stepCount = 10;
  expectInvalid(desc, "Solver::Moments|TableSizes::stepCount");
  desc.solver = Solver::ONeil;
  desc.sizes.nodesR = 10;
  expectInvalid(desc, "Solver::ONeil|TableSizes::nodesR");
  EXPECT_EQ(resolveTableDesc(preset("earth"), nullptr, {}), Status::InvalidArgument);
}

TEST_F(TablesTest, NullIsRefusedWithASentence) {
  message().clear();
  EXPECT_EQ(createTables(context(), preset("earth"), {}, nullptr), Status::InvalidArgument);
  EXPECT_TRUE(hasAll(message(), "createTables got a null argument")) << message();
}

TEST_F(TablesTest, ADescriptionIsCompletedOnceAndForAll) {
  const Parameters earth = preset("earth");
  TableDesc sunset;
  sunset.sunZenithFrom = 1.4;
  sunset.sunZenithTo = 1.7;
  TableDesc clear;
  clear.disabledEffects = effectBit(Effect::Mie) | effectBit(Effect::MultipleScattering);
  TableDesc compute;
  compute.readerStages = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  compute.lights[0].irradiance = {{1.0, 2.0, 3.0}};
  for (TableDesc desc : {TableDesc{}, sunset, clear, compute}) {
    for (const Solver solver : {Solver::Moments, Solver::Standard, Solver::ONeil,
                                Solver::HoffmanPreetham, Solver::Hillaire}) {
      const bool ofMoments = desc.sunZenithTo != 0.0 || desc.disabledEffects != 0;
      if (solver != Solver::Moments && ofMoments) continue;
      desc.solver = solver;
      TableDesc once = desc;
      ASSERT_EQ(resolveTableDesc(earth, &once, {}), Status::Ok);
      TableDesc twice = once;
      ASSERT_EQ(resolveTableDesc(earth, &twice, {}), Status::Ok);
      EXPECT_TRUE(sameDesc(once, twice)) << static_cast<uint32_t>(solver);
      Tables* given = make(desc);
      Tables* resolved = make(once);
      EXPECT_TRUE(sameDesc(infoOf(given).desc, once)) << static_cast<uint32_t>(solver);
      EXPECT_TRUE(sameDesc(infoOf(resolved).desc, once)) << static_cast<uint32_t>(solver);
      for (uint32_t id = 0; id < kTableIdCount; ++id)
        EXPECT_EQ(imageOf(given, TableId(id)).bytes, imageOf(resolved, TableId(id)).bytes) << id;
      destroyTables(given);
      destroyTables(resolved);
    }
  }
  TableDesc standard;
  standard.solver = Solver::Standard;
  ASSERT_EQ(resolveTableDesc(earth, &standard, {}), Status::Ok);
  EXPECT_EQ(standard.sizes.transmittanceMu, 256u);
  EXPECT_EQ(standard.sizes.scatteringNu, 8u);
  EXPECT_EQ(standard.sizes.degree, 0u);
  EXPECT_EQ(standard.orders, 5u);
  EXPECT_EQ(standard.wavelengthCount, 3u);
  EXPECT_EQ(standard.lights[0].kind, LightKind::Star);
  EXPECT_EQ(standard.lights[0].irradiance[1], earth.solarIrradiance[1]);
  EXPECT_EQ(standard.lights[3].kind, LightKind::None);
}

// Without a frame that has completed, what is recorded stays Recorded.
TEST_F(TablesTest, StatesFollowTheBake) {
  TableDesc desc;
  desc.quality = Quality::Draft;
  Tables* tables = make(desc);
  EXPECT_EQ(infoOf(tables).state, TablesState::Empty);
  uint64_t lastFrame = 0;
  BakeProgress progress;
  while (!progress.done) {
    run([&](VkCommandBuffer commands) {
      lastFrame = device().frame();
      EXPECT_EQ(advanceFrame(context(), lastFrame, lastFrame - 1), Status::Ok);
      return recordBake(tables, commands, 0, &progress) == Status::Ok;
    });
    EXPECT_EQ(infoOf(tables).state, progress.done ? TablesState::Recorded : TablesState::Baking);
  }
  const uint64_t next = device().frame();
  ASSERT_EQ(advanceFrame(context(), next, lastFrame - 1), Status::Ok);
  EXPECT_EQ(infoOf(tables).state, TablesState::Recorded);
  ASSERT_EQ(advanceFrame(context(), next, lastFrame), Status::Ok);
  EXPECT_EQ(infoOf(tables).state, TablesState::Complete);
  destroyTables(tables);
}

TEST_F(TablesTest, ImagesAreDescribedByTheirId) {
  TableDesc desc;
  desc.quality = Quality::Draft;
  Tables* tables = make(desc);
  EXPECT_EQ(imageOf(tables, kTableMoments).layout, VK_IMAGE_LAYOUT_UNDEFINED);
  bakeAll(device(), tables);
  const TablesInfo info = infoOf(tables);
  EXPECT_NE(info.set, VkDescriptorSet{VK_NULL_HANDLE});
  EXPECT_EQ(info.setLayout, infoOf(this->tables("mars")).setLayout);
  for (uint32_t id = 0; id < kTableIdCount; ++id) {
    const ImageInfo& image = info.images[id];
    ASSERT_EQ(image.name != nullptr, id <= kTableSource) << id;
    if (image.name == nullptr) continue;
    EXPECT_NE(image.image, VkImage{VK_NULL_HANDLE}) << id;
    EXPECT_NE(image.view, VkImageView{VK_NULL_HANDLE}) << id;
    const uint64_t texel = image.format == VK_FORMAT_R16G16B16A16_SFLOAT ? 8 : 16;
    EXPECT_EQ(image.bytes, texel * image.extent.width * image.extent.height * image.extent.depth);
    EXPECT_EQ(image.layout, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) << id;
    EXPECT_EQ(image.stage,
              VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT)
        << id;
    EXPECT_EQ(image.access, VK_ACCESS_2_SHADER_SAMPLED_READ_BIT) << id;
  }
  EXPECT_EQ(info.images[kTableOpticalDepth].extent.width, info.desc.sizes.depthMu);
  EXPECT_STREQ(info.images[kTableSource].name, "source");
  destroyTables(tables);
}

// A compute-only queue accepts no other stage; validation would report it.
TEST_F(TablesTest, OnlyTheReadersThatThereAreWait) {
  ContextDesc contextDesc = this->contextDesc();
  realInstanceProc = contextDesc.getInstanceProcAddr;
  contextDesc.getInstanceProcAddr = watchedInstanceProc;
  Context* made = nullptr;
  ASSERT_EQ(createContext(contextDesc, &made), Status::Ok) << lastDiagnostic();
  for (const VkPipelineStageFlags2 readers :
       {VkPipelineStageFlags2{0}, VkPipelineStageFlags2{VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT},
        VkPipelineStageFlags2{VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT}}) {
    TableDesc desc;
    desc.quality = Quality::Draft;
    desc.cpuQueries = CpuQueries::All;
    desc.readerStages = readers;
    Tables* tables = nullptr;
    ASSERT_EQ(createTables(made, preset("earth"), desc, &tables), Status::Ok) << lastDiagnostic();
    bakeAll(device(), tables);
    const VkPipelineStageFlags2 expected =
        readers != 0
            ? readers
            : VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    EXPECT_EQ(readersOfLastBarrier, expected);
    for (const TableId id : {kTableOpticalDepth, kTableMoments, kTableSource})
      EXPECT_EQ(imageOf(tables, id).stage, expected) << id;
    const headless::HostBuffer buffer =
        device().createHostBuffer(kProbeAnswerBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, nullptr);
    const ProbeQuery query;
    const bool computes = (expected & VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT) != 0;
    run([&](VkCommandBuffer commands) {
      EXPECT_EQ(recordProbe(tables, commands, &query, 1, buffer.buffer()),
                computes ? Status::Ok : Status::InvalidArgument);
      return true;
    });
    if (!computes) {
      EXPECT_TRUE(hasAll(lastDiagnostic(), "recordProbe|readerStages|0x80")) << lastDiagnostic();
    }
    destroyTables(tables);
  }
  destroyContext(made);
}

}  // namespace
}  // namespace alpenglow::testing
