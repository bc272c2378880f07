// Frames that never execute, and frames that still do: a bake, an upload and a readback across
// abandonFrame and advanceFrame.
#include <cstring>

#include "tests/tables/bake_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr TableId kIds[] = {kTableOpticalDepth, kTableIrradiance, kTableScattering,
                            kTableSingleMie};

TableDesc tinyDesc() {
  TableDesc desc = standardDesc({.transmittanceMu = 32,
                                 .transmittanceR = 8,
                                 .irradianceMuS = 8,
                                 .irradianceR = 4,
                                 .scatteringR = 4,
                                 .scatteringMu = 8,
                                 .scatteringMuS = 8,
                                 .scatteringNu = 3});
  desc.orders = 3;
  return desc;
}

/// Counts frames itself. All that was submitted has executed, but `completed_` may stay behind.
class AbandonTest : public BakeTest {
 protected:
  /// The next frame, with what is recorded in it.
  void submit(const std::function<Status(VkCommandBuffer)>& record) {
    begin();
    run([&](VkCommandBuffer commands) {
      const Status status = record(commands);
      EXPECT_EQ(status, Status::Ok) << lastDiagnostic();
      return status == Status::Ok;
    });
  }
  /// The same, but the commands are never submitted.
  void drop(const std::function<Status(VkCommandBuffer)>& record) {
    begin();
    std::string error;
    device().run(
        [&](VkCommandBuffer commands) {
          EXPECT_EQ(record(commands), Status::Ok) << lastDiagnostic();
          return false;
        },
        &error);
  }
  void abandon(uint64_t frame) {
    ASSERT_EQ(abandonFrame(context(), frame), Status::Ok) << lastDiagnostic();
  }
  /// Everything up to the frame that is recorded now has completed.
  void complete() {
    completed_ = frame_;
    ASSERT_EQ(advanceFrame(context(), frame_, completed_), Status::Ok) << lastDiagnostic();
  }
  uint64_t frame() const { return frame_; }

  static std::function<Status(VkCommandBuffer)> slice(Tables* tables, BakeProgress* progress) {
    return
        [=](VkCommandBuffer commands) { return recordBake(tables, commands, 300'000, progress); };
  }
  void bakeRest(Tables* tables) {
    BakeProgress progress;
    while (!progress.done && !HasFailure()) submit(slice(tables, &progress));
  }
  TableCopies readAll(Tables* tables) {
    TableCopies copies;
    for (TableId id : kIds) copies[id] = read(tables, id);
    return copies;
  }
  TableCopies undisturbed() { return readAll(bakeTables(preset("earth"), tinyDesc())); }
  uint64_t imagesNow() {
    ResourceReport report;
    resourceReport(context(), &report);
    return report.images;
  }

 private:
  void begin() {
    ++frame_;
    ASSERT_EQ(advanceFrame(context(), frame_, completed_), Status::Ok) << lastDiagnostic();
  }
  uint64_t frame_ = 1, completed_ = 0;
};

// At every slice of a bake: it is dropped, and recorded once more.
TEST_F(AbandonTest, TheNewestFrameIsRepeated) {
  const TableCopies wanted = undisturbed();
  Tables* tables = makeTables(preset("earth"), tinyDesc());
  BakeProgress dropped, progress;
  uint32_t slices = 0;
  while (!progress.done && !HasFailure()) {
    const TablesState before = infoOf(tables).state;
    drop(slice(tables, &dropped));
    abandon(frame());
    EXPECT_EQ(infoOf(tables).state, before);
    submit(slice(tables, &progress));
    EXPECT_EQ(progress.unitsDone, dropped.unitsDone);
    EXPECT_EQ(progress.passIndex, dropped.passIndex);
    EXPECT_EQ(progress.done, dropped.done);
    ++slices;
  }
  EXPECT_GT(slices, progress.passCount);
  expectSameBytes(wanted, readAll(tables), "with each slice dropped once");
}

// Within one frame: it begins before the first of its slices, and may be recorded anew.
TEST_F(AbandonTest, AllSlicesOfTheFrameAreRepeated) {
  const TableCopies wanted = undisturbed();
  Tables* tables = makeTables(preset("earth"), tinyDesc());
  BakeProgress progress;
  submit(slice(tables, &progress));
  const uint64_t before = progress.unitsDone;
  drop([&](VkCommandBuffer commands) {
    for (int i = 0; i < 3; ++i) {
      const Status status = recordBake(tables, commands, 300'000, &progress);
      if (status != Status::Ok) return status;
    }
    return Status::Ok;
  });
  abandon(frame());
  run([&](VkCommandBuffer commands) {  // The same frame again.
    return recordBake(tables, commands, 300'000, &progress) == Status::Ok;
  });
  EXPECT_EQ(progress.unitsDone, before + progress.unitsRecorded);
  abandon(frame() - 1);  // Something of it counts still: from the start.
  EXPECT_EQ(infoOf(tables).state, TablesState::Empty);
  bakeRest(tables);
  expectSameBytes(wanted, readAll(tables), "with a frame recorded twice");
}

TEST_F(AbandonTest, AFrameWithLaterSlicesRestartsTheBake) {
  const TableCopies wanted = undisturbed();
  for (const bool newestFirst : {false, true}) {
    Tables* tables = makeTables(preset("earth"), tinyDesc());
    BakeProgress progress;
    for (int i = 0; i < 5; ++i) submit(slice(tables, &progress));
    drop(slice(tables, &progress));
    drop(slice(tables, &progress));
    if (newestFirst) abandon(frame());
    abandon(frame() - 1);
    if (!newestFirst) abandon(frame());
    EXPECT_EQ(infoOf(tables).state, TablesState::Empty);
    submit(slice(tables, &progress));
    EXPECT_EQ(progress.unitsDone, progress.unitsRecorded);
    EXPECT_EQ(progress.passIndex, 0u);
    bakeRest(tables);
    expectSameBytes(wanted, readAll(tables), "after a restart");
  }
}

// The last slice, with its frame in flight: what the bake needs is still there.
TEST_F(AbandonTest, ScratchStaysUntilTheLastFrameHasCompleted) {
  const TableCopies wanted = undisturbed();
  complete();  // Its scratch goes.
  Tables* tables = makeTables(preset("earth"), tinyDesc());
  const uint64_t whileBaking = imagesNow();
  BakeProgress progress;
  while (progress.passIndex + 2 < progress.passCount || progress.passCount == 0)
    submit(slice(tables, &progress));
  drop(slice(tables, &progress));
  while (!progress.done && !HasFailure()) {
    abandon(frame());
    submit(slice(tables, &progress));
    drop(slice(tables, &progress));
  }
  EXPECT_EQ(infoOf(tables).state, TablesState::Recorded);
  EXPECT_EQ(imagesNow(), whileBaking);
  abandon(frame());
  EXPECT_NE(infoOf(tables).state, TablesState::Recorded);
  bakeRest(tables);
  EXPECT_EQ(imagesNow(), whileBaking);
  complete();
  EXPECT_EQ(imagesNow(), whileBaking - 5);  // dE, dS, dJ, dL and its Mie part
  EXPECT_EQ(infoOf(tables).state, TablesState::Complete);
  expectSameBytes(wanted, readAll(tables), "after the last slice was dropped");
  // What has completed stays.
  EXPECT_EQ(abandonFrame(context(), frame()), Status::InvalidArgument);
  EXPECT_NE(lastDiagnostic().find("abandonFrame got frame"), std::string::npos) << lastDiagnostic();
  EXPECT_EQ(infoOf(tables).state, TablesState::Complete);
}

TEST_F(AbandonTest, AnUploadThatNeverExecutesIsNone) {
  const TableCopies wanted = undisturbed();
  Tables* tables = makeTables(preset("earth"), tinyDesc());
  std::map<TableId, headless::HostBuffer> buffers;
  for (const auto& [id, table] : wanted) {
    buffers[id] =
        device().createHostBuffer(table.bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, nullptr);
    std::memcpy(buffers[id].data(), table.bytes.data(), table.bytes.size());
  }
  const auto uploadOf = [&](TableId id) {
    return [&, id](VkCommandBuffer commands) {
      return recordTableUpload(tables, commands, id, buffers[id].buffer(), 0);
    };
  };
  for (TableId id : kIds)
    if (id != kTableSingleMie) submit(uploadOf(id));
  drop(uploadOf(kTableSingleMie));
  EXPECT_EQ(infoOf(tables).state, TablesState::Recorded);
  abandon(frame());
  EXPECT_EQ(infoOf(tables).state, TablesState::Baking);
  EXPECT_EQ(readbackStatus(tables, kTableScattering), Status::NotReady);
  submit(uploadOf(kTableSingleMie));
  complete();
  EXPECT_EQ(infoOf(tables).state, TablesState::Complete);
  expectSameBytes(wanted, readAll(tables), "after an upload was dropped");
}

TEST_F(AbandonTest, ReadbacksThatNeverExecuteLeaveTheTablesAsTheyAre) {
  const TableCopies wanted = undisturbed();
  for (const bool keepOrders : {false, true}) {
    TableDesc desc = tinyDesc();
    desc.keepOrders = keepOrders;
    Tables* tables = makeTables(preset("earth"), desc);
    bakeRest(tables);
    complete();
    const headless::HostBuffer buffer = device().createHostBuffer(
        imageOf(tables, kTableScattering).bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, nullptr);
    const auto readback = [&](VkCommandBuffer commands) {
      return recordTableReadback(tables, commands, kTableScattering, buffer.buffer(), 0);
    };
    drop(readback);
    drop(readback);
    abandon(frame() - 1);
    EXPECT_EQ(infoOf(tables).state, TablesState::Complete);
    abandon(frame());
    EXPECT_EQ(infoOf(tables).state, TablesState::Complete);
    submit(readback);
    EXPECT_EQ(std::memcmp(buffer.data(), wanted.at(kTableScattering).bytes.data(), buffer.size()),
              0);
    expectSameBytes(wanted, readAll(tables), "after dropped readbacks");
  }
}

// A host that is two frames ahead: what it destroys outlives both.
TEST_F(AbandonTest, AdvancingFreesNothingThatIsInFlight) {
  Tables* tables = nullptr;
  ASSERT_EQ(createTables(context(), preset("earth"), tinyDesc(), &tables), Status::Ok);
  const uint64_t alive = imagesNow();
  BakeProgress progress;
  submit(slice(tables, &progress));
  const uint64_t last = frame();
  destroyTables(tables);
  EXPECT_EQ(imagesNow(), alive);
  for (uint64_t ahead = 1; ahead <= 2; ++ahead) {
    ASSERT_EQ(advanceFrame(context(), last + ahead, last - 1), Status::Ok);
    EXPECT_EQ(imagesNow(), alive) << ahead;
  }
  ASSERT_EQ(advanceFrame(context(), last + 2, last), Status::Ok);
  EXPECT_EQ(imagesNow(), 0u);
}

TEST_F(AbandonTest, FrameNumbersAreChecked) {
  ASSERT_EQ(advanceFrame(context(), 5, 3), Status::Ok);
  const auto refused = [&](uint64_t submitting, uint64_t completed, const char* part) {
    EXPECT_EQ(advanceFrame(context(), submitting, completed), Status::InvalidArgument);
    EXPECT_NE(lastDiagnostic().find(part), std::string::npos) << lastDiagnostic();
  };
  refused(4, 3, "falls");
  refused(6, 2, "falls");
  refused(6, 7, "before it is recorded");
  refused(0, 0, "counts from 1");
  EXPECT_EQ(advanceFrame(context(), 5, 3), Status::Ok) << "The numbers have changed.";
  EXPECT_EQ(abandonFrame(context(), 3), Status::InvalidArgument);
  EXPECT_EQ(abandonFrame(context(), 6), Status::InvalidArgument);
  EXPECT_EQ(abandonFrame(context(), 5), Status::Ok);
  EXPECT_EQ(abandonFrame(context(), 4), Status::Ok);
  EXPECT_EQ(advanceFrame(nullptr, 1, 0), Status::InvalidArgument);
  EXPECT_EQ(abandonFrame(nullptr, 1), Status::InvalidArgument);
}

}  // namespace
}  // namespace alpenglow::testing
