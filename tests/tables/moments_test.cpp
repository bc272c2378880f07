// The bake of the moment solver: same bytes however sliced, tables of single orders, upload,
// numbers that are finite, and nothing of the other solver.
#include <cmath>
#include <random>

#include "tests/parameters/heard.h"
#include "tests/tables/bake_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr TableId kFinalTables[] = {kTableOpticalDepth, kTableMoments, kTableSource};

TableDesc tinyDesc(uint32_t orders) {
  TableDesc desc;
  desc.orders = orders;
  desc.sizes = kTinySettings;
  return desc;
}

class MomentsTest : public BakeTest {
 protected:
  TableCopies readAll(Tables* tables) {
    TableCopies copies;
    for (TableId id : kFinalTables) copies[id] = read(tables, id);
    return copies;
  }
};

TEST_F(MomentsTest, TheBytesDoNotDependOnTheBudget) {
  const Parameters earth = preset("earth");
  const TableCopies whole = readAll(bakeTables(earth, tinyDesc(4), 0));
  for (uint64_t budget : {uint64_t(1), uint64_t(20'000), uint64_t(1'000'000)}) {
    const TableCopies sliced = readAll(bakeTables(earth, tinyDesc(4), budget));
    expectSameBytes(whole, sliced, "at budget " + std::to_string(budget));
  }
  std::mt19937 random(7);
  Tables* tables = makeTables(earth, tinyDesc(4));
  BakeProgress progress;
  while (!progress.done && !HasFailure()) {
    run([&](VkCommandBuffer commands) {
      return recordBake(tables, commands, random() % 100'000, &progress) == Status::Ok;
    });
  }
  expectSameBytes(whole, readAll(tables), "at random budgets");
}

TEST_F(MomentsTest, ThePassesAreNamedAndCounted) {
  Tables* tables = makeTables(preset("earth"), tinyDesc(3));
  std::string passes;
  uint64_t done = 0;
  BakeProgress progress;
  while (!progress.done && !HasFailure()) {
    run([&](VkCommandBuffer commands) {
      return recordBake(tables, commands, 0, &progress) == Status::Ok;
    });
    done += progress.unitsRecorded;
    EXPECT_TRUE(progress.passFinished);
    passes += std::string(progress.pass) + ", ";
  }
  EXPECT_EQ(done, progress.unitsTotal);
  EXPECT_EQ(
      passes,
      "T, Q, Y, W, L 1, F 1, M 1, R 1, H 1, N 1, I 1, J 2, L 2, F 2, M 2, R 2, H 2, N 2, I 2, "
      "J 3, N sum, I sum, J sum, ");
}

TEST_F(MomentsTest, EveryPresetAndFormatIsFinite) {
  for (const Preset& listed : testing::allPresets()) {
    for (TableFormat format : {TableFormat::Half, TableFormat::Float}) {
      TableDesc desc = tinyDesc(0);
      desc.format = format;
      const TableCopies copies = readAll(bakeTables(preset(listed.name), desc));
      for (const auto& [id, table] : copies) {
        bool good = true, lit = false;
        for (float v : table.values) {
          good = good && std::isfinite(v) && (v >= 0.0f || id == kTableMoments);
          lit = lit || v > 0.0f;
        }
        EXPECT_TRUE(good) << listed.name << " " << table.info.name;
        EXPECT_TRUE(lit) << listed.name << " " << table.info.name << " is all zero";
      }
    }
  }
}

// Sources are scattered at least twice: with one order there are none, nor any light that makes
// them.
TEST_F(MomentsTest, OneOrderHasNoMultipleScattering) {
  const TableCopies copies = readAll(bakeTables(preset("earth"), tinyDesc(1)));
  for (float v : copies.at(kTableSource).values) ASSERT_EQ(v, 0.0f);
  const CpuTable& moments = copies.at(kTableMoments);
  const uint32_t rows = moments.info.extent.height / 5;
  for (uint32_t x = 0; x < moments.info.extent.width; ++x)
    for (uint32_t y = 0; y < rows; ++y)
      for (int c = 0; c < 3; ++c)
        for (uint32_t layer : {0u, 4u})
          ASSERT_LT(moments.texel(x, y + layer * rows)[c], -69.0f)
              << "ln of the darkness is -69.08";
}

TEST_F(MomentsTest, MoreOrdersAreBrighterAndTheTailIsBrightest) {
  std::vector<CpuTable> tables;
  for (uint32_t orders : {2u, 3u, 5u, 0u})
    tables.push_back(read(bakeTables(preset("earth"), tinyDesc(orders)), kTableMoments));
  for (size_t i = 1; i < tables.size(); ++i) {
    // At the nodes: cubics between them are free to cross.
    const uint32_t rows = tables[i].info.extent.height / 5, step = fieldTexels(2) - 1;
    for (uint32_t x = 0; x < tables[i].info.extent.width; x += step)
      for (uint32_t y = 0; y < rows; y += step)
        for (int c = 0; c < 3; ++c)
          for (uint32_t layer : {0u, 4u}) {
            const float less = tables[i - 1].texel(x, y + layer * rows)[c];
            const float more = tables[i].texel(x, y + layer * rows)[c];
            ASSERT_GE(more, less - 1e-4f) << x << " " << y << " layer " << layer;
          }
  }
}

TEST_F(MomentsTest, AnUploadGivesTheSameTables) {
  const Parameters earth = preset("earth");
  const TableCopies baked = readAll(bakeTables(earth, tinyDesc(3)));
  Tables* uploaded = makeTables(earth, tinyDesc(3));
  for (const auto& [id, table] : baked) {
    EXPECT_FALSE(ready(uploaded));
    upload(uploaded, id, table);
  }
  EXPECT_TRUE(ready(uploaded));
  expectSameBytes(baked, readAll(uploaded), "after an upload");
}

// With two orders the sum is the one order that was solved.
TEST_F(MomentsTest, TablesOfOrdersAreReadRightAfterTheirPass) {
  TableDesc desc = tinyDesc(2);
  desc.keepOrders = true;
  desc.format = TableFormat::Float;
  Tables* tables = makeTables(preset("earth"), desc);
  const auto status = [&](TableId id) { return readbackStatus(tables, id); };
  bake(tables, 0, "M 1");
  EXPECT_EQ(status(kTableOrderMoments), Status::NotReady);
  EXPECT_TRUE(diagnostics().empty()) << lastDiagnostic();  // It is no error.
  EXPECT_EQ(status(kTableOrderScattering), Status::Unsupported);
  EXPECT_NE(lastDiagnostic().find("Solver::Standard"), std::string::npos) << lastDiagnostic();
  bake(tables, 0, "N 1");
  EXPECT_EQ(status(kTableOrderSource), Status::NotReady);
  const CpuTable orderMoments = read(tables, kTableOrderMoments);
  bake(tables, 0, "J 2");
  EXPECT_EQ(status(kTableOrderMoments), Status::NotReady);
  const CpuTable orderSource = read(tables, kTableOrderSource);
  bake(tables);
  const CpuTable moments = read(tables, kTableMoments);
  const uint32_t step = fieldTexels(2) - 1, nodes = orderMoments.info.extent.height / 5;
  for (uint32_t layer = 0; layer < 5; ++layer)
    for (uint32_t y = 0; y < nodes; ++y)
      for (uint32_t x = 0; x < orderMoments.info.extent.width; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(orderMoments.texel(x, y + layer * nodes)[c],
                      moments.texel(step * x, step * y + layer * fieldTexels(nodes))[c], 1e-5)
              << x << " " << y << " layer " << layer;
  const CpuTable source = read(tables, kTableSource);
  for (size_t i = 0; i < source.values.size(); ++i)
    ASSERT_NEAR(source.values[i], orderSource.values[i], 1e-4f * source.values[i] + 1e-6f);
}

TEST_F(MomentsTest, ScratchIsFreedWhenTheLastFrameCompletes) {
  ResourceReport before, after;
  Tables* tables = makeTables(preset("earth"), tinyDesc(4));
  resourceReport(context(), &before);
  bake(tables);
  finishFrames(context());
  resourceReport(context(), &after);
  EXPECT_LT(after.bytes, before.bytes);
  EXPECT_EQ(after.images, 3u);
}

}  // namespace
}  // namespace alpenglow::testing
