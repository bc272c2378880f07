// Lives of objects: destroyed with frames in flight, uploaded instead of baked, counted.
#include <utility>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

FrameState someDraw() {
  return makeDraw(cameraFromGeodetic(preset("earth"), 0.0, 0.0, 2.0, 0.0, 0.1, 0.0, 1.0),
                  {0.6, 0.0, 0.8}, {24, 16});
}

// Tables and view are destroyed right after they were recorded: the frame that uses them is
// submitted all the same, and validation would say if they were gone.
TEST_F(StandardSkyTest, DestroyedInFlightLivesUntilTheFrameCompletes) {
  Context* made = nullptr;
  ASSERT_EQ(createContext(contextDesc(), &made), Status::Ok);
  Tables* baked = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), smallTables(), &baked), Status::Ok);
  bakeAll(device(), baked);
  View* view = nullptr;
  ViewDesc viewDesc;
  viewDesc.sky = SkyMethod::Integrate;
  viewDesc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  ASSERT_EQ(createView(made, baked, viewDesc, &view), Status::Ok);
  TargetDesc targetDesc;
  targetDesc.extent = {24, 16};
  Target target(device(), targetDesc);
  ResourceReport report;
  const uint64_t frame = device().skipFrame();
  ASSERT_EQ(advanceFrame(made, frame, frame - 1), Status::Ok);
  const Picture drawn = target.draw([&](VkCommandBuffer commands) {
    const Status status = testing::recordSky(view, commands, baked, someDraw());
    destroyView(view);
    destroyTables(baked);
    EXPECT_EQ(advanceFrame(made, frame, frame - 1), Status::Ok);
    resourceReport(made, &report);
    return status == Status::Ok;
  });
  EXPECT_GT(report.bytes, 0u);
  EXPECT_EQ(report.images, 4u);
  EXPECT_EQ(device().frame(), frame + 1);
  EXPECT_EQ(drawn.data, picture(someDraw()).data);
  finishFrames(made);
  resourceReport(made, &report);
  EXPECT_EQ(report.bytes, 0u);
  EXPECT_EQ(report.images, 0u);
  EXPECT_EQ(report.buffers, 0u);
  destroyContext(made);
  EXPECT_TRUE(diagnostics().empty()) << lastDiagnostic();
}

// In the middle of a bake, too; and what still waits goes with the context.
TEST_F(StandardSkyTest, BakesCanBeCancelled) {
  Context* made = nullptr;
  ASSERT_EQ(createContext(contextDesc(), &made), Status::Ok);
  Tables* half = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), smallTables(), &half), Status::Ok);
  run([&](VkCommandBuffer commands) {
    BakeProgress progress;
    for (int i = 0; i < 4; ++i)
      EXPECT_EQ(recordBake(half, commands, 500000, &progress), Status::Ok);
    EXPECT_FALSE(progress.done);
    destroyTables(half);
    return true;
  });
  finishFrames(made);
  ResourceReport report;
  resourceReport(made, &report);
  EXPECT_EQ(report.bytes, 0u);
  destroyTables(nullptr);

  Tables* waiting = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), smallTables(), &waiting), Status::Ok);
  destroyTables(waiting);
  destroyContext(made);
  EXPECT_TRUE(diagnostics().empty()) << lastDiagnostic();
}

// On a device of its own, whose validation would report a leak.
TEST_F(StandardSkyTest, ForgottenObjectsGoWithTheContext) {
  auto other = makeDevice();
  ASSERT_NE(other, nullptr);
  ContextDesc desc = other->contextDesc();
  desc.diagnostics = contextDesc().diagnostics;
  Context* made = nullptr;
  ASSERT_EQ(createContext(desc, &made), Status::Ok);
  Tables* baked = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), smallTables(), &baked), Status::Ok);
  View* forgotten = nullptr;
  ViewDesc viewDesc;
  viewDesc.sky = SkyMethod::Integrate;
  viewDesc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  ASSERT_EQ(createView(made, baked, viewDesc, &forgotten), Status::Ok);
  destroyContext(made);
  EXPECT_TRUE(diagnostics().empty()) << lastDiagnostic();
  other.reset();
}

TEST_F(StandardSkyTest, UploadedTablesDrawTheSameBytes) {
  Context* made = nullptr;
  ContextDesc desc = contextDesc();
  desc.capabilities = kCapabilitySky;
  ASSERT_EQ(createContext(desc, &made), Status::Ok);
  for (const MieStorage mie : {MieStorage::Full, MieStorage::Packed}) {
    Tables* const baked = tables("earth", mie);
    Tables* uploaded = nullptr;
    ASSERT_EQ(createTables(made, preset("earth"), smallTables(mie), &uploaded), Status::Ok);
    std::vector<TableId> ids = {kTableOpticalDepth, kTableIrradiance, kTableScattering};
    if (mie == MieStorage::Full) ids.push_back(kTableSingleMie);
    for (const TableId id : ids) {
      EXPECT_FALSE(ready(uploaded));
      const ImageInfo info = imageOf(baked, id);
      ASSERT_NE(info.name, nullptr);
      const headless::HostBuffer bytes = device().createHostBuffer(
          info.bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, nullptr);
      run([&](VkCommandBuffer commands) {
        return recordTableReadback(baked, commands, id, bytes.buffer(), 0) == Status::Ok;
      });
      run([&](VkCommandBuffer commands) {
        return recordTableUpload(uploaded, commands, id, bytes.buffer(), 0) == Status::Ok;
      });
    }
    EXPECT_TRUE(ready(uploaded));
    ViewDesc viewDesc;
    viewDesc.sky = SkyMethod::Integrate;
    viewDesc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
    TargetDesc target;
    target.extent = {24, 16};
    const Picture fromBake = picture(makeView(viewDesc, baked), baked, someDraw(), target);
    View* view = nullptr;
    ASSERT_EQ(createView(made, uploaded, viewDesc, &view), Status::Ok);
    EXPECT_EQ(picture(view, uploaded, someDraw(), target).data, fromBake.data);
    destroyView(view);
    destroyTables(uploaded);
  }
  destroyContext(made);
}

TEST_F(StandardSkyTest, ResourcesAreCounted) {
  Context* made = nullptr;
  ASSERT_EQ(createContext(contextDesc(), &made), Status::Ok);
  ResourceReport report;
  resourceReport(made, &report);
  EXPECT_EQ(report.bytes + report.images + report.buffers + report.dispatches + report.draws, 0u);
  Tables* baked = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), smallTables(), &baked), Status::Ok);
  resourceReport(made, &report);
  const uint64_t whileBaking = report.bytes;
  EXPECT_EQ(report.images, 9u);
  EXPECT_EQ(report.buffers, 1u);
  EXPECT_EQ(report.dispatches, 0u);
  bakeAll(device(), baked);
  finishFrames(made);
  resourceReport(made, &report);
  EXPECT_EQ(report.dispatches, 7u);  // T, dE 1, dS 1, and dL, dJ, dE, dS of order 2.
  EXPECT_EQ(report.images, 4u);
  EXPECT_LT(report.bytes, whileBaking);
  EXPECT_EQ(report.peakBytes, whileBaking);
  const uint64_t variantsOfBake = report.shaderVariants;
  EXPECT_EQ(report.pipelines, variantsOfBake);

  ViewDesc viewDesc;
  viewDesc.sky = SkyMethod::Integrate;
  viewDesc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  View* views[2] = {};
  for (View*& view : views) ASSERT_EQ(createView(made, baked, viewDesc, &view), Status::Ok);
  resourceReport(made, &report);
  EXPECT_EQ(report.pipelines, variantsOfBake + 12);
  EXPECT_EQ(report.shaderVariants, variantsOfBake + 6);
  TargetDesc target;
  target.extent = {24, 16};
  picture(views[0], baked, someDraw(), target);
  picture(views[1], baked, someDraw(), target);
  resourceReport(made, &report);
  EXPECT_EQ(report.draws, 2u);
  for (View* view : views) destroyView(view);
  destroyTables(baked);
  finishFrames(made);
  resourceReport(made, &report);
  EXPECT_EQ(report.bytes + report.images + report.buffers, 0u);
  EXPECT_EQ(report.peakBytes, whileBaking);
  destroyContext(made);
}

// A LUT of a frame that never executes is recorded again, and draws what it would have drawn.
TEST_F(SkyTest, ALutOfAnAbandonedFrameIsRecordedAgain) {
  Context* made = nullptr;
  ASSERT_EQ(createContext(contextDesc(), &made), Status::Ok);
  TableDesc draft;
  draft.quality = Quality::Draft;
  Tables* baked = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), draft, &baked), Status::Ok);
  bakeAll(device(), baked);
  ViewDesc viewDesc;
  viewDesc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  View* view = nullptr;
  ASSERT_EQ(createView(made, baked, viewDesc, &view), Status::Ok) << lastDiagnostic();
  TargetDesc targetDesc;
  targetDesc.extent = {24, 16};
  Target target(device(), targetDesc);
  const FrameDesc desc = frameDesc(someDraw());
  FrameWork work;
  uint64_t frame = 1, updates = 0;
  const auto begin = [&] {
    ++frame;
    ASSERT_EQ(advanceFrame(made, frame, frame - 2), Status::Ok) << lastDiagnostic();
    ASSERT_EQ(beginFrame(view, desc, &work), Status::Ok) << lastDiagnostic();
  };
  const auto drawn = [&] {
    run([&](VkCommandBuffer commands) { return recordLuts(view, commands) == Status::Ok; });
    return target.draw([&](VkCommandBuffer commands) {
      return alpenglow::recordSky(view, commands) == Status::Ok;
    });
  };
  const auto updated = [&] {
    ResourceReport report;
    resourceReport(made, &report);
    return std::exchange(updates, report.lutUpdates) != report.lutUpdates;
  };
  begin();
  EXPECT_TRUE(work.record & kRecordLuts);
  std::string error;
  device().run(
      [&](VkCommandBuffer commands) {
        EXPECT_EQ(recordLuts(view, commands), Status::Ok);
        return false;
      },
      &error);
  EXPECT_TRUE(updated());
  begin();
  EXPECT_FALSE(work.record & kRecordLuts) << "It is kept for the same frame.";
  ASSERT_EQ(abandonFrame(made, frame - 1), Status::Ok);
  begin();
  EXPECT_TRUE(work.record & kRecordLuts);
  const Picture first = drawn();
  EXPECT_TRUE(updated());
  begin();
  EXPECT_FALSE(work.record & kRecordLuts);
  EXPECT_EQ(drawn().data, first.data);
  EXPECT_FALSE(updated());
  // What destroyContext finds alive, it destroys.
  destroyContext(made);
  EXPECT_TRUE(diagnostics().empty()) << lastDiagnostic();
}

// Between beginFrame and the record functions of a frame, and between frames in flight, nothing
// that they use goes away: not with a picture of another size, nor with tables that are destroyed.
TEST_F(SkyTest, TablesMayBeDestroyedWhileTheirFramesAreInFlight) {
  Context* made = nullptr;
  ASSERT_EQ(createContext(contextDesc(), &made), Status::Ok);
  TableDesc draft;
  draft.quality = Quality::Draft;
  Tables *first = nullptr, *second = nullptr;
  ASSERT_EQ(createTables(made, preset("earth"), draft, &first), Status::Ok);
  ASSERT_EQ(createTables(made, preset("mars"), draft, &second), Status::Ok);
  bakeAll(device(), first);
  bakeAll(device(), second);
  finishFrames(made);
  ViewDesc viewDesc;
  viewDesc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  viewDesc.sky = SkyMethod::Integrate;
  View* view = nullptr;
  ASSERT_EQ(createView(made, first, viewDesc, &view), Status::Ok) << lastDiagnostic();
  ResourceReport before, report;
  resourceReport(made, &before);
  TargetDesc targetDesc;
  targetDesc.extent = {24, 16};
  Target target(device(), targetDesc);
  const uint64_t frame = device().frame();
  ASSERT_EQ(advanceFrame(made, frame, frame - 1), Status::Ok);
  const Picture drawn = target.draw([&](VkCommandBuffer commands) {
    const Status status = testing::recordSky(view, commands, nullptr, someDraw());
    destroyTables(first);
    EXPECT_EQ(advanceFrame(made, frame + 1, frame - 1), Status::Ok);
    resourceReport(made, &report);
    EXPECT_EQ(report.images, before.images);
    EXPECT_EQ(report.bytes, before.bytes);
    return status == Status::Ok;
  });
  EXPECT_EQ(drawn.data, picture(someDraw()).data);
  // The tables of createView are gone; others serve.
  EXPECT_EQ(beginFrame(view, frameDesc(someDraw()), nullptr), Status::InvalidArgument);
  EXPECT_NE(lastDiagnostic().find("FrameDesc::tables"), std::string::npos) << lastDiagnostic();
  EXPECT_EQ(beginFrame(view, frameDesc(someDraw(), second), nullptr), Status::Ok);
  EXPECT_EQ(advanceFrame(made, frame + 1, frame), Status::Ok);
  resourceReport(made, &report);
  EXPECT_LT(report.images, before.images);
  destroyView(view);
  destroyTables(second);
  destroyContext(made);
}

}  // namespace
}  // namespace alpenglow::testing
