#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/table_file.h>

#include <cmath>

#include <alpenglow/table_limits.h>
#include "small_table.h"
#include "temporary_folder.h"

namespace alpenglow::io {
namespace {

using test::contentsOf;
using test::expectSentence;
using test::makeTables;
using test::smallDescs;
using test::smallMoments;
using test::smallStandard;
using test::TemporaryFolder;

void expectSame(const TableFile& a, const TableFile& b, size_t parts) {
  EXPECT_EQ(firstDifference(a.parameters, b.parameters), "");
  EXPECT_EQ(a.desc.solver, b.desc.solver);
  EXPECT_EQ(a.desc.orders, b.desc.orders);
  EXPECT_EQ(a.desc.quality, b.desc.quality);
  EXPECT_EQ(momentSettingsText(a.desc.sizes), momentSettingsText(b.desc.sizes));
  EXPECT_EQ(a.desc.format, b.desc.format);
  EXPECT_EQ(a.desc.mie, b.desc.mie);
  EXPECT_EQ(transmittanceSizeText(a.desc.sizes), transmittanceSizeText(b.desc.sizes));
  EXPECT_EQ(irradianceSizeText(a.desc.sizes), irradianceSizeText(b.desc.sizes));
  EXPECT_EQ(scatteringSizeText(a.desc.sizes), scatteringSizeText(b.desc.sizes));
  ASSERT_EQ(b.parts.size(), parts);
  for (size_t i = 0; i < parts; ++i) {
    EXPECT_EQ(a.parts[i].name, b.parts[i].name);
    EXPECT_EQ(a.parts[i].width, b.parts[i].width);
    EXPECT_EQ(a.parts[i].height, b.parts[i].height);
    EXPECT_EQ(a.parts[i].depth, b.parts[i].depth);
    EXPECT_EQ(a.parts[i].format, b.parts[i].format);
    EXPECT_EQ(a.parts[i].texels, b.parts[i].texels);
  }
}

std::vector<TableDesc> everyForm() {
  std::vector<TableDesc> forms;
  for (const TableFormat format : {TableFormat::Half, TableFormat::Float}) {
    for (TableDesc desc : smallDescs()) {
      desc.format = format;
      forms.push_back(desc);
    }
    forms.push_back(smallStandard());
    forms.back().format = format;
    forms.back().mie = MieStorage::Packed;
    for (const Quality quality : {Quality::Draft, Quality::Ultra}) {
      forms.push_back(smallMoments());
      forms.back().format = format;
      forms.back().quality = quality;
      forms.back().orders = 3;
    }
  }
  return forms;
}

TEST(TableFile, ComesBackBitForBitInEveryForm) {
  TemporaryFolder folder;
  for (const TableDesc& desc : everyForm()) {
    for (const bool orders : {false, true}) {
      const TableFile file = makeTables(desc, orders);
      const Done done = writeTableFile(folder / "t.exr", file);
      ASSERT_TRUE(done) << done.error;
      const Result<TableFile> all = readTableFile(folder / "t.exr", true);
      ASSERT_TRUE(all) << all.error;
      expectSame(file, *all, file.parts.size());
      const Result<TableFile> main = readTableFile(folder / "t.exr");
      ASSERT_TRUE(main) << main.error;
      const bool full = desc.solver == Solver::Standard && desc.mie == MieStorage::Full;
      expectSame(file, *main, full ? 4 : 3);
    }
  }
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST(TableFile, PartsOfTheMomentSolverHaveTheShapesOfItsTables) {
  const TableFile file = makeTables(smallMoments(), true);
  ASSERT_EQ(file.parts.size(), 7u);
  const auto expectShape = [&](const char* name, uint32_t width, uint32_t height, uint32_t depth) {
    const TablePart* part = file.find(name);
    ASSERT_NE(part, nullptr) << name;
    EXPECT_EQ(part->width, width) << name;
    EXPECT_EQ(part->height, height) << name;
    EXPECT_EQ(part->depth, depth) << name;
  };
  expectShape("optical_depth", 4, 3, 1);  // mu, h
  expectShape("moments", 7, 20, 1);  // mu_s, 5 layers of r: 3 x 2 nodes, two texels between them
  for (const char* name : {"moments_order_1", "moments_order_2"}) expectShape(name, 3, 10, 1);
  for (const char* name : {"source", "source_order_2", "source_order_3"}) {
    expectShape(name, 6, 3, 2);  // theta x phi, mu_s, r
  }
}

// A device without linear filtering of floats holds them as halves.
TEST(TableFile, OpticalDepthAndMomentsMayBeHalf) {
  TemporaryFolder folder;
  TableFile file = makeTables(smallMoments(), true);
  for (TablePart& part : file.parts) convertTexels(&part, TableFormat::Half);
  const Done done = writeTableFile(folder / "t.exr", file);
  ASSERT_TRUE(done) << done.error;
  const Result<TableFile> again = readTableFile(folder / "t.exr", true);
  ASSERT_TRUE(again) << again.error;
  expectSame(file, *again, 7);
}

TEST(TableFile, TheSameTablesMakeTheSameBytes) {
  TemporaryFolder folder;
  for (const TableDesc& desc : smallDescs()) {
    const TableFile file = makeTables(desc, true);
    ASSERT_TRUE(writeTableFile(folder / "a.exr", file));
    ASSERT_TRUE(writeTableFile(folder / "b.exr", file));
    EXPECT_EQ(contentsOf(folder / "a.exr"), contentsOf(folder / "b.exr"));
  }
}

TEST(TableFile, PartsAreFoundByName) {
  const TableFile file = makeTables(smallStandard(), true);
  ASSERT_NE(file.find("scattering_order_2"), nullptr);
  EXPECT_EQ(file.find("scattering_order_2")->depth, 2u);
  EXPECT_EQ(file.find("scattering")->width, 6u);  // mu_s x nu
  EXPECT_EQ(file.find("scattering_order_3"), nullptr);
}

TEST(TableFile, UnwritablePlacesAreRefused) {
  TemporaryFolder folder;
  const TableFile file = makeTables(smallStandard(), false);
  for (const std::string& path :
       {folder / "no/t.exr", folder.path(), std::string("/dev/full"), std::string("/proc/t.exr")}) {
    expectSentence(writeTableFile(path, file).error);
  }
  EXPECT_TRUE(folder.names().empty());
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(TableFile, OnlyWholeTablesAreWritten) {
  TemporaryFolder folder;
  const auto refused = [&](const TableFile& bad, const std::string& mention) {
    const Done done = writeTableFile(folder / "t.exr", bad);
    expectSentence(done.error);
    EXPECT_NE(done.error.find(mention), std::string::npos) << done.error;
  };
  for (const TableDesc& desc : smallDescs()) {
    const TableFile good = makeTables(desc, true);
    TableFile bad = good;
    bad.parts.erase(bad.parts.begin() + 1);
    refused(bad, good.parts[1].name);
    bad = good;
    bad.parts[2].texels.pop_back();
    refused(bad, good.parts[2].name);
    bad = good;
    bad.parts.back().name = "irradiance_order_3";
    refused(bad, "irradiance_order_3");
    bad = good;
    bad.parts.back().name = "source_order_1001";
    refused(bad, "source_order_1001");
    bad.parts.back().name = "source_order_1";
    refused(bad, "source_order_1");
    bad = good;
    bad.parts.resize(2);
    refused(bad, good.parts[2].name);
    bad = good;
    convertTexels(&bad.parts[2], TableFormat::Float);
    refused(bad, good.parts[2].name);
  }
  TableFile bad = makeTables(smallMoments(), false);
  bad.desc.quality = Quality::Default;
  refused(bad, "quality");
  EXPECT_TRUE(folder.names().empty());
}

TEST(TableFile, OtherFilesAreRefused) {
  TemporaryFolder folder;
  expectSentence(readTableFile(folder / "absent.exr").error);
  expectSentence(readTableFile(folder.path()).error);
  expectSentence(readTableFile("/dev/null").error);
  expectSentence(readTableFile(folder.write("a.exr", "hello")).error);
  expectSentence(readTableFile(folder.write("a.exr", "\x76\x2F\x31\x01 and more")).error);
}

TEST(TableFile, TexelsChangeTheirFormat) {
  TablePart part = makeTables(smallStandard(), false).parts[1];
  const std::vector<uint8_t> halves = part.texels;
  convertTexels(&part, TableFormat::Float);
  EXPECT_EQ(part.texels.size(), 2 * halves.size());
  const auto bits = static_cast<uint32_t>(halves[0] | halves[1] << 8);  // Positive and normal.
  float value = 0.0f;
  std::memcpy(&value, part.texels.data(), sizeof value);
  EXPECT_EQ(value, std::ldexp(static_cast<float>(bits % 1024) + 1024.0f,
                              static_cast<int>(bits / 1024) - 25));
  convertTexels(&part, TableFormat::Half);
  EXPECT_EQ(part.texels, halves);
}

TEST(TableSizes, TextGoesBothWays) {
  TableSizes sizes;
  ASSERT_TRUE(parseTransmittanceSize("256x64", &sizes));
  ASSERT_TRUE(parseIrradianceSize("64x16", &sizes));
  ASSERT_TRUE(parseScatteringSize("32x128x33x8", &sizes));
  EXPECT_EQ(sizes.transmittanceMu, 256u);
  EXPECT_EQ(sizes.irradianceR, 16u);
  EXPECT_EQ(sizes.scatteringR, 32u);
  EXPECT_EQ(sizes.scatteringMuS, 33u);
  EXPECT_EQ(transmittanceSizeText(sizes), "256x64");
  EXPECT_EQ(irradianceSizeText(sizes), "64x16");
  EXPECT_EQ(scatteringSizeText(sizes), "32x128x33x8");
  for (const char* bad : {"", "256", "x", "256x", "256x64x3", "0x3", "-1x3", "4097x2", "2 x3",
                          "99999999999999999999x2", "2x3 ", "2X3", "0x10x3"}) {
    EXPECT_FALSE(parseTransmittanceSize(bad, &sizes)) << bad;
  }
  EXPECT_FALSE(parseScatteringSize("2x2x2", &sizes));
  EXPECT_EQ(transmittanceSizeText(sizes), "256x64");
}

TEST(TableSizes, LimitsAreSentences) {
  const auto refused = [](const TableDesc& desc, const std::string& mention) {
    const std::string error = checkSizes(desc).error;
    expectSentence(error);
    EXPECT_NE(error.find(mention), std::string::npos) << error;
  };
  for (const TableDesc& desc : smallDescs()) EXPECT_TRUE(checkSizes(desc));
  TableDesc desc = smallStandard();
  desc.sizes.scatteringMu = 5;
  refused(desc, "even");
  desc = smallStandard();
  desc.sizes.irradianceR = 1;
  refused(desc, "1");
  desc = smallStandard();
  desc.sizes.scatteringR = desc.sizes.scatteringMuS = desc.sizes.scatteringMu = 4096;
  refused(desc, "texels");
  desc = smallMoments();
  desc.sizes.degree = kMaxDegree + 1;
  refused(desc, "degree");
  desc = smallMoments();
  desc.sizes.viewPanels = 0;
  refused(desc, "viewPanels");
  desc = smallMoments();
  desc.sizes.sourceGamma = desc.sizes.sourcePsi = 4096;
  desc.sizes.nodesR = 3;
  desc.sizes.nodesMuS = 2;
  refused(desc, "100663296");
  desc.sizes.nodesR = desc.sizes.nodesMuS = 4096;
  refused(desc, std::to_string(12286 * 12286 * 5));
}

TEST(TableSettings, DefaultsFollowSolverAndQuality) {
  Parameters earth;
  ASSERT_EQ(findPreset("earth", &earth, {}), Status::Ok);
  TableDesc desc;
  desc.solver = Solver::Standard;
  desc = resolved(desc, earth);
  EXPECT_EQ(desc.orders, 5u);
  EXPECT_EQ(scatteringSizeText(desc.sizes), "32x128x32x8");
  EXPECT_EQ(momentSettingsText(desc.sizes), "");
  EXPECT_EQ(desc.quality, Quality::Default);

  TableDesc whole;
  ASSERT_EQ(resolveTableDesc(earth, &whole, {}), Status::Ok);
  desc = resolved(TableDesc{}, earth);
  EXPECT_EQ(desc.solver, Solver::Moments);
  EXPECT_EQ(desc.orders, 0u);
  EXPECT_EQ(desc.quality, Quality::Medium);
  EXPECT_EQ(scatteringSizeText(desc.sizes), "0x0x0x0");
  EXPECT_TRUE(checkSizes(desc)) << checkSizes(desc).error;
  EXPECT_EQ(momentSettingsText(desc.sizes), momentSettingsText(whole.sizes));

  TableDesc custom;
  custom.quality = Quality::High;
  custom.sizes.nodesR = 7;
  custom = resolved(custom, earth);
  EXPECT_EQ(custom.quality, Quality::High);
  EXPECT_EQ(custom.sizes.nodesR, 7u);
  EXPECT_TRUE(checkSizes(custom)) << checkSizes(custom).error;
}

TEST(TableSettings, MomentSettingsGoBothWays) {
  TableSizes settings;
  ASSERT_TRUE(parseMomentSettings("nodesR=16", &settings));
  ASSERT_TRUE(parseMomentSettings("degree=12,nodesR=17", &settings));
  EXPECT_EQ(settings.nodesR, 17u);
  EXPECT_EQ(settings.degree, 12u);
  EXPECT_EQ(momentSettingsText(settings), "nodesR=17,degree=12");
  EXPECT_EQ(momentSettingsText({}), "");
  const std::string all = momentSettingsText(smallMoments().sizes);
  EXPECT_EQ(all,
            "depthMu=4,depthH=3,nodesR=2,nodesMuS=3,ringsSky=4,ringsLimb=2,ringsGround=3,"
            "azimuths=5,degree=4,sourceGamma=3,sourcePsi=2,solverPanels=2,viewPanels=2");
  TableSizes again;
  ASSERT_TRUE(parseMomentSettings(all, &again));
  EXPECT_EQ(momentSettingsText(again), all);
  for (const char* bad :
       {"", ",", "nodesR", "nodesR=", "nodesR=16,", "nodesR=1", "nodesR=4097", "nodesR=-2",
        "nodesR=2.5", "nodesR=99999999999999999999", "nodesr=4", "nodes=4", "degree=48",
        "nodesR=4,nodesR=4", "nodesR=4 degree=4", "nodesR=4,,degree=4", " nodesR=4", "=4"}) {
    expectSentence(parseMomentSettings(bad, &settings).error);
  }
  EXPECT_EQ(momentSettingsText(settings), "nodesR=17,degree=12");
}

TEST(TableSettings, NamesGoBothWays) {
  EXPECT_EQ(solverName(Solver::Moments), "moments");
  EXPECT_EQ(solverName(Solver::Standard), "standard");
  for (const std::string& name : solverNames()) EXPECT_EQ(solverName(*findSolver(name)), name);
  EXPECT_FALSE(findSolver("Moments"));
  EXPECT_EQ(qualityName(Quality::Draft), "draft");
  EXPECT_EQ(qualityName(Quality::Medium), "medium");
  EXPECT_EQ(qualityName(Quality::Ultra), "ultra");
  EXPECT_EQ(qualityNames().size(), 5u);
  for (const std::string& name : qualityNames()) EXPECT_EQ(qualityName(*findQuality(name)), name);
  EXPECT_FALSE(findQuality("default"));
}

}  // namespace
}  // namespace alpenglow::io
