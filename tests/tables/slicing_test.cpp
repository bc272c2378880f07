// Slices, formats and storage: same bytes however sliced, nothing but finite numbers at or above
// zero, upload gives back what was read, scratch goes away.
#include <cmath>
#include <random>

#include "tests/parameters/heard.h"
#include "tests/tables/bake_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr TableId kFinalTables[] = {kTableOpticalDepth, kTableIrradiance, kTableScattering,
                                    kTableSingleMie};
constexpr TableSizes kTinySizes = {.transmittanceMu = 32,
                                   .transmittanceR = 8,
                                   .irradianceMuS = 8,
                                   .irradianceR = 4,
                                   .scatteringR = 4,
                                   .scatteringMu = 8,
                                   .scatteringMuS = 8,
                                   .scatteringNu = 3};

TableDesc tinyDesc() {
  TableDesc desc = standardDesc(kTinySizes);
  desc.orders = 3;
  return desc;
}

class SlicingTest : public BakeTest {
 protected:
  TableCopies readAll(Tables* tables, bool packed = false) {
    TableCopies copies;
    for (TableId id : kFinalTables)
      if (!packed || id != kTableSingleMie) copies[id] = read(tables, id);
    return copies;
  }
};

TEST_F(SlicingTest, TheBytesDoNotDependOnTheBudget) {
  const Parameters earth = preset("earth");
  const TableCopies whole = readAll(bakeTables(earth, tinyDesc(), 0));
  for (uint64_t budget : {uint64_t(1), uint64_t(20'000), uint64_t(1'000'000)}) {
    const TableCopies sliced = readAll(bakeTables(earth, tinyDesc(), budget));
    expectSameBytes(whole, sliced, "at budget " + std::to_string(budget));
  }
  // A budget that changes from call to call.
  std::mt19937 random(7);
  Tables* tables = makeTables(earth, tinyDesc());
  BakeProgress progress;
  while (!progress.done && !HasFailure()) {
    run([&](VkCommandBuffer commands) {
      return recordBake(tables, commands, random() % 500'000, &progress) == Status::Ok;
    });
  }
  expectSameBytes(whole, readAll(tables), "at random budgets");
}

TEST_F(SlicingTest, ACallStaysInItsPassAndItsBudget) {
  Tables* tables = makeTables(preset("earth"), tinyDesc());
  uint64_t done = 0;
  uint32_t lastPass = 0, calls = 0;
  BakeProgress progress;
  constexpr uint64_t kBudget = 300'000;
  std::string passes;
  while (!progress.done && !HasFailure()) {
    run([&](VkCommandBuffer commands) {
      return recordBake(tables, commands, kBudget, &progress) == Status::Ok;
    });
    ++calls;
    done += progress.unitsRecorded;
    EXPECT_GT(progress.unitsRecorded, 0u);
    EXPECT_EQ(progress.unitsDone, done);
    EXPECT_GE(progress.passIndex, lastPass);
    EXPECT_LE(progress.passIndex, lastPass + 1);
    lastPass = progress.passIndex;
    if (progress.passFinished) passes += std::string(progress.pass) + ", ";
  }
  EXPECT_EQ(done, progress.unitsTotal);
  EXPECT_GT(calls, progress.passCount);
  EXPECT_EQ(passes, "T, dE 1, dS 1, dL 2, dJ 2, dE 2, dS 2, dL 3, dJ 3, dE 3, dS 3, ");
  // One call more does nothing, and says that all is done.
  run([&](VkCommandBuffer commands) {
    return recordBake(tables, commands, 0, &progress) == Status::Ok;
  });
  EXPECT_TRUE(progress.done);
  EXPECT_EQ(progress.unitsRecorded, 0u);
}

TEST_F(SlicingTest, EveryPresetFormatAndStorageIsFiniteAndNotNegative) {
  for (const Preset& listed : testing::allPresets()) {
    for (TableFormat format : {TableFormat::Half, TableFormat::Float}) {
      for (MieStorage mie : {MieStorage::Full, MieStorage::Packed}) {
        TableDesc desc = tinyDesc();
        desc.format = format;
        desc.mie = mie;
        const TableCopies copies =
            readAll(bakeTables(preset(listed.name), desc), mie == MieStorage::Packed);
        for (const auto& [id, table] : copies) {
          bool good = true, lit = false;
          for (float v : table.values) {
            good = good && std::isfinite(v) && v >= 0.0f;
            lit = lit || v > 0.0f;
          }
          EXPECT_TRUE(good) << listed.name << " " << table.info.name;
          if (id != kTableSingleMie || preset(listed.name).mie.present) {
            EXPECT_TRUE(lit) << listed.name << " " << table.info.name << " is all zero";
          }
        }
      }
    }
  }
}

TEST_F(SlicingTest, ExtremePlanetsAreFinite) {
  // Sizes and media at the ends of what the validator lets through.
  struct Case {
    const char* name;
    double radius, thickness, scaleHeight, asymmetry, scattering;
  };
  for (const Case& c : {Case{"10 km planet", 1e4, 2e3, 500.0, 0.8, 1e-4},
                        Case{"100,000 km planet", 1e8, 1e5, 8e3, 0.8, 1e-5},
                        Case{"scale height 100 m", 6.36e6, 6e4, 100.0, 0.8, 1e-3},
                        Case{"scale height 50 km", 6.36e6, 5e5, 5e4, 0.8, 1e-6},
                        Case{"g 0.99", 6.36e6, 6e4, 1200.0, 0.99, 2e-5},
                        Case{"g -0.99", 6.36e6, 6e4, 1200.0, -0.99, 2e-5},
                        Case{"optical depth 50", 6.36e6, 6e4, 1200.0, 0.8, 50.0 / 1200.0}}) {
    Parameters p = preset("earth-fig6");
    p.bottomRadius_m = c.radius;
    p.topRadius_m = c.radius + c.thickness;
    p.mie.scaleHeight_m = c.scaleHeight;
    p.mie.asymmetry = c.asymmetry;
    for (uint32_t i = 0; i < kSpectrumSize; ++i)
      p.mie.scattering_per_m[i] = p.mie.extinction_per_m[i] = c.scattering;
    const TableCopies copies = readAll(bakeTables(p, tinyDesc()));
    for (const auto& [id, table] : copies)
      for (float v : table.values)
        ASSERT_TRUE(std::isfinite(v) && v >= 0.0f) << c.name << " " << table.info.name;
  }
}

TEST_F(SlicingTest, AnUploadGivesTheSameTables) {
  const Parameters earth = preset("earth");
  const TableCopies baked = readAll(bakeTables(earth, tinyDesc()));
  Tables* uploaded = makeTables(earth, tinyDesc());
  EXPECT_FALSE(ready(uploaded));
  for (const auto& [id, table] : baked) {
    upload(uploaded, id, table);
  }
  EXPECT_TRUE(ready(uploaded));
  expectSameBytes(baked, readAll(uploaded), "after an upload");
}

TEST_F(SlicingTest, ScratchIsFreedWhenTheLastFrameCompletes) {
  ResourceReport before, after;
  Tables* tables = makeTables(preset("earth"), tinyDesc());
  resourceReport(context(), &before);
  bake(tables);
  finishFrames(context());
  resourceReport(context(), &after);
  EXPECT_LT(after.bytes, before.bytes);
  EXPECT_EQ(after.images, before.images - 5);  // dE, dS, dJ, dL and its Mie part
}

TEST_F(SlicingTest, OneOrderHasNoSkyIrradianceAndMoreOrdersAreBrighter) {
  TableDesc one = tinyDesc();
  one.orders = 1;
  const TableCopies single = readAll(bakeTables(preset("earth"), one));
  for (float v : single.at(kTableIrradiance).values) ASSERT_EQ(v, 0.0f);
  const TableCopies three = readAll(bakeTables(preset("earth"), tinyDesc()));
  const CpuTable& a = single.at(kTableScattering);
  const CpuTable& b = three.at(kTableScattering);
  for (size_t i = 0; i < a.values.size(); ++i) ASSERT_LE(a.values[i], b.values[i] * 1.001f);
}

}  // namespace
}  // namespace alpenglow::testing
