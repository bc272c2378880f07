// Frames of a view: what beginFrame answers and refuses, which LUTs are kept, and what an abandoned
// frame takes back.
#include "tests/passes/sky/frame_fixture.h"

namespace alpenglow::testing {
namespace {

TEST_F(FrameTest, LutsAreKeptWhileAltitudeSunAndTablesStay) {
  View* const view = makeView({});
  View* const fresh = makeView({});
  const FrameState draw = drawAt(1000.0, 0.4);
  const auto frame = [&](const FrameState& state, Tables* with, bool recorded) {
    nextFrame();
    const ResourceReport before = report();
    FrameWork work;
    run([&](VkCommandBuffer commands) {
      EXPECT_EQ(beginFrame(view, frameDesc(state, with), &work), Status::Ok) << message();
      EXPECT_EQ((work.record & kRecordLuts) != 0, recorded);
      EXPECT_NE(work.record & kRecordSky, 0u);
      EXPECT_EQ(alpenglow::recordLuts(view, commands), Status::Ok) << message();
      return true;
    });
    const ResourceReport after = report();
    EXPECT_EQ(after.lutUpdates - before.lutUpdates, recorded ? 1u : 0u);
    EXPECT_EQ(after.lutsSkipped - before.lutsSkipped, recorded ? 0u : 1u);
    EXPECT_EQ(after.dispatches - before.dispatches, recorded ? 1u : 0u);
    // What was kept is what would be recorded.
    recordViewLuts(fresh, with, state);
    EXPECT_EQ(picture(view, with, state).data, picture(fresh, with, state).data);
  };
  Tables* const earth = tables();
  Tables* const hazy = tables("earth-hazy");
  frame(draw, earth, true);
  frame(draw, earth, false);
  frame(drawAt(1000.0, 0.4, 2.0), earth, false);
  frame(movedSideways(draw, 0.02, 1.0), earth, false);
  frame(movedSideways(draw, -1.3, 4.0), earth, false);
  FrameState brighter = draw;
  brighter.radianceScale = 64.0;
  frame(brighter, earth, false);
  frame(drawAt(1000.5, 0.4), earth, true);
  frame(drawAt(1000.5, 0.401), earth, true);
  frame(drawAt(1000.5, 0.401), hazy, true);
  frame(drawAt(1000.5, 0.401), earth, true);
  frame(drawAt(1000.5, 0.401), earth, false);
}

TEST_F(FrameTest, RecordingNeedsBeginFrameOfThisFrame) {
  View* const view = makeView({});
  const auto expectRefused = [&] {
    for (const RecordCall& call : kRecordCalls) {
      message().clear();
      EXPECT_EQ(call.record(view, kNoCommands), Status::InvalidArgument) << call.name;
      const std::string frame = "frame " + std::to_string(device().frame());
      EXPECT_TRUE(hasAll(message(), call.name + ("|without beginFrame|" + frame))) << message();
    }
  };
  nextFrame();
  expectRefused();
  EXPECT_EQ(beginFrame(view, frameDesc(drawAt(2.0, 0.4)), nullptr), Status::Ok) << message();
  nextFrame();
  expectRefused();
}

TEST_F(FrameTest, NothingIsRecordedAfterAFailure) {
  View* const view = makeView({});
  TableDesc draft;
  draft.quality = Quality::Draft;
  Tables* unbaked = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), draft, &unbaked), Status::Ok);
  const FrameDesc good = frameDesc(drawAt(2.0, 0.4));
  const auto expectNotReady = [&] {
    message().clear();
    for (const RecordCall& call : kRecordCalls)
      EXPECT_EQ(call.record(view, kNoCommands), Status::NotReady) << call.name;
    EXPECT_EQ(message(), "");
  };
  const auto expectZero = [](const FrameWork& work) {
    EXPECT_EQ(work.record, 0u);
    EXPECT_EQ(work.visible, 0u);
    EXPECT_EQ(work.altitude_m, 0.0);
    EXPECT_EQ(work.illuminance[0], 0.0);
    EXPECT_EQ(work.sets[kViewSetTables], VK_NULL_HANDLE);
    EXPECT_EQ(work.images[kViewSkyLut].name, nullptr);
  };
  const ResourceReport before = report();
  FrameWork work;
  ASSERT_EQ(beginFrame(view, good, &work), Status::Ok);
  EXPECT_NEAR(work.altitude_m, 2.0, 1e-6);
  EXPECT_NE(work.visible & kVisibleSky, 0u);
  EXPECT_NE(work.sets[kViewSetTables], VK_NULL_HANDLE);
  EXPECT_NE(work.images[kViewSkyLut].name, nullptr);
  FrameDesc bad = good;
  bad.cameras[0].up[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(beginFrame(view, bad, &work), Status::InvalidArgument);
  expectZero(work);
  expectNotReady();
  FrameDesc early = good;
  early.tables = unbaked;
  message().clear();
  ASSERT_EQ(beginFrame(view, good, &work), Status::Ok);
  EXPECT_EQ(beginFrame(view, early, &work), Status::NotReady);
  EXPECT_EQ(message(), "");
  expectZero(work);
  expectNotReady();
  const ResourceReport after = report();
  EXPECT_EQ(after.dispatches, before.dispatches);
  EXPECT_EQ(after.draws, before.draws);
  // The view is as it was.
  recordViewLuts(view, tables(), drawAt(2.0, 0.4));
  EXPECT_EQ(badValue(picture(view, tables(), drawAt(2.0, 0.4))), "");
  destroyTables(unbaked);
}

TEST_F(FrameTest, AbandonedLutsAreRecordedAgain) {
  View* const view = makeView({});
  const FrameState draw = drawAt(2.0, 0.4);
  recordViewLuts(view, tables(), draw);
  const Picture before = picture(view, tables(), draw);
  const FrameState later = drawAt(2.0, 0.5);
  const uint64_t frame = nextFrame();
  recordInVain([&](VkCommandBuffer commands) {
    EXPECT_EQ(testing::recordLuts(view, commands, tables(), later), Status::Ok) << message();
  });
  ASSERT_EQ(abandonFrame(context(), frame), Status::Ok) << message();
  for (const FrameState& state : {later, draw}) {
    nextFrame();
    expectNeedsSlice(view, tables(), state);
    const uint64_t updates = report().lutUpdates;
    recordViewLuts(view, tables(), state);
    EXPECT_EQ(report().lutUpdates, updates + 1);
  }
  EXPECT_EQ(picture(view, tables(), draw).data, before.data);
}

class StandardFrameTest : public StandardSkyTest {
 protected:
  std::vector<unsigned char> bytesOf(Tables* tables, TableId id) {
    const ImageInfo info = imageOf(tables, id);
    std::string error;
    const headless::HostBuffer buffer =
        device().createHostBuffer(info.bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &error);
    run([&](VkCommandBuffer commands) {
      return recordTableReadback(tables, commands, id, buffer.buffer(), 0) == Status::Ok;
    });
    const auto* bytes = static_cast<const unsigned char*>(buffer.data());
    return {bytes, bytes + info.bytes};
  }
};

TEST_F(StandardFrameTest, AnAbandonedBakeCompletesWithTheSameBytes) {
  Tables* const whole = tables();
  Tables* resumed = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), smallTables(), &resumed), Status::Ok);
  BakeProgress progress;
  finishFrames(context());
  run([&](VkCommandBuffer commands) {
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(recordBake(resumed, commands, 0, &progress), Status::Ok) << message();
    return true;
  });
  const uint64_t done = progress.unitsDone;
  finishFrames(context());
  const uint64_t frame = device().frame();
  std::string error;
  EXPECT_FALSE(device().run(
      [&](VkCommandBuffer commands) {
        while (!progress.done)
          if (recordBake(resumed, commands, 0, &progress) != Status::Ok) break;
        return false;
      },
      &error));
  EXPECT_TRUE(progress.done);
  EXPECT_TRUE(ready(resumed));
  const FrameDesc desc =
      frameDesc(makeDraw(cameraFromGeodetic(preset("earth"), 0.0, 0.0, 2.0, 0.0, 0.1, 0.0, 1.0),
                         sunAt(0.4), kExtent),
                resumed);
  EXPECT_EQ(beginFrame(view(), desc, nullptr), Status::Ok) << message();
  ASSERT_EQ(abandonFrame(context(), frame), Status::Ok) << message();
  EXPECT_EQ(infoOf(resumed).state, TablesState::Baking);
  finishFrames(context());
  EXPECT_EQ(beginFrame(view(), desc, nullptr), Status::NotReady);
  EXPECT_EQ(alpenglow::recordSky(view(), kNoCommands), Status::NotReady);
  progress = {};
  run([&](VkCommandBuffer commands) {
    EXPECT_EQ(recordBake(resumed, commands, 0, &progress), Status::Ok) << message();
    EXPECT_EQ(progress.unitsDone, done + progress.unitsRecorded);
    return true;
  });
  bakeAll(device(), resumed);
  EXPECT_TRUE(ready(resumed));
  EXPECT_EQ(beginFrame(view(), desc, nullptr), Status::Ok) << message();
  for (const TableId id : {kTableOpticalDepth, kTableIrradiance, kTableScattering, kTableSingleMie})
    EXPECT_EQ(bytesOf(resumed, id), bytesOf(whole, id)) << id;
  destroyTables(resumed);
}

TEST_F(FrameTest, DestroyedTablesAreNoDefault) {
  TableDesc desc;
  desc.solver = Solver::Moments;
  desc.quality = Quality::Draft;
  Tables* first = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), desc, &first), Status::Ok);
  View* const view = makeView({}, first);
  const FrameState draw = drawAt(2.0, 0.4);
  EXPECT_EQ(beginFrame(view, frameDesc(draw), nullptr), Status::NotReady);  // They aren't baked.
  destroyTables(first);
  message().clear();
  EXPECT_EQ(beginFrame(view, frameDesc(draw), nullptr), Status::InvalidArgument);
  EXPECT_TRUE(hasAll(message(), "FrameDesc::tables is null|createView|destroyed")) << message();
  EXPECT_EQ(beginFrame(view, frameDesc(draw, tables()), nullptr), Status::Ok) << message();

  // Nor can a frame be recorded whose tables have gone since.
  Tables* second = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), desc, &second), Status::Ok);
  bakeAll(device(), second);
  EXPECT_EQ(beginFrame(view, frameDesc(draw, second), nullptr), Status::Ok) << message();
  destroyTables(second);
  for (const RecordCall& call : kRecordCalls)
    EXPECT_EQ(call.record(view, kNoCommands), Status::NotReady) << call.name;
}

TEST_F(FrameTest, WhatLaterVersionsTakeIsRefused) {
  struct BadFrame {
    const char* expected;  ///< Parts of the sentence, separated by '|'.
    std::function<void(FrameDesc&)> spoil;
  };
  const float horizon = 0.0f;
  const BadFrame frames[] = {
      {"FrameDesc::cameras", [](FrameDesc& d) { d.cameras[1] = d.cameras[0]; }},
      {"FrameDesc::cameras", [](FrameDesc& d) { d.cameras[3] = d.cameras[0]; }},
      {"FrameDesc::lights", [](FrameDesc& d) { d.lights[1] = d.lights[0]; }},
      {"FrameDesc::lights", [](FrameDesc& d) { d.lights[3] = d.lights[0]; }},
      {"cameras[0].jitter", [](FrameDesc& d) { d.cameras[0].jitter[1] = 0.5; }},
      {"cameras[0].tangents", [](FrameDesc& d) { d.cameras[0].tangents[2] = 0.3; }},
      {"lights[0].litFrom", [](FrameDesc& d) { d.lights[0].litFrom[0] = 1.0; }},
      {"lights[0].shadowMap",
       [](FrameDesc& d) { d.lights[0].shadowMap = reinterpret_cast<const LightMap*>(&d); }},
      {"lights[0].clouds",
       [](FrameDesc& d) { d.lights[0].clouds = reinterpret_cast<const LightMap*>(&d); }},
      {"World::metersPerUnit|1000", [](FrameDesc& d) { d.world.metersPerUnit = 1000.0; }},
      {"World::equatorialRadius_m", [](FrameDesc& d) { d.world.equatorialRadius_m = 6378137.0; }},
      {"polarRadius_m", [](FrameDesc& d) { d.world.polarRadius_m = 6356752.0; }},
      {"FrameDesc::horizon", [&](FrameDesc& d) { d.horizon = &horizon; }},
      {"FrameDesc::horizon", [](FrameDesc& d) { d.horizonCount = 4; }},
  };
  View* const view = makeView({});
  for (const BadFrame& bad : frames) {
    FrameDesc desc = frameDesc(drawAt(2.0, 0.4), tables());
    bad.spoil(desc);
    message().clear();
    EXPECT_EQ(beginFrame(view, desc, nullptr), Status::Unsupported) << bad.expected;
    EXPECT_TRUE(hasAll(message(), bad.expected)) << bad.expected << ": " << message();
  }
  struct BadView {
    const char* expected;
    std::function<void(ViewDesc&)> spoil;
  };
  const BadView views[] = {
      {"ViewDesc::viewMask", [](ViewDesc& d) { d.viewMask = 3; }},
      {"ViewDesc::color", [](ViewDesc& d) { d.color = ColorSpace::Rec2020; }},
      {"ViewDesc::color", [](ViewDesc& d) { d.color = ColorSpace::Xyz; }},
      {"ViewDesc::skyLightDegree", [](ViewDesc& d) { d.skyLightDegree = 2; }},
      {"ViewDesc::environmentSize", [](ViewDesc& d) { d.environmentSize = 64; }},
      {"ViewDesc::environmentLevels", [](ViewDesc& d) { d.environmentLevels = 5; }},
      {"ViewDesc::environmentFlags", [](ViewDesc& d) { d.environmentFlags = 1; }},
      {"ViewDesc::lutTolerance", [](ViewDesc& d) { d.lutTolerance = 0.01; }},
      {"ViewDesc::lutFrames", [](ViewDesc& d) { d.lutFrames = 2; }},
      {"ViewDesc::aerialPerspective|LutOnly",
       [](ViewDesc& d) { d.aerialPerspective = AerialPerspective::LutOnly; }},
  };
  for (const BadView& bad : views) {
    ViewDesc desc;
    desc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
    bad.spoil(desc);
    message().clear();
    View* made = reinterpret_cast<View*>(uintptr_t{1});
    EXPECT_EQ(createView(context(), tables(), desc, &made), Status::Unsupported) << bad.expected;
    EXPECT_EQ(made, nullptr);
    EXPECT_TRUE(hasAll(message(), bad.expected)) << bad.expected << ": " << message();
  }
}

}  // namespace
}  // namespace alpenglow::testing
