#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/table_file.h>

#include <cmath>

#include "small_table.h"
#include "temporary_folder.h"

namespace alpenglow::io {
namespace {

using test::contentsOf;
using test::expectSentence;
using test::makeTables;
using test::smallDesc;
using test::TemporaryFolder;

void expectSame(const TableFile& a, const TableFile& b, size_t parts) {
  EXPECT_EQ(firstDifference(a.parameters, b.parameters), "");
  EXPECT_EQ(a.desc.orders, b.desc.orders);
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

TEST(TableFile, ComesBackBitForBitInEveryForm) {
  TemporaryFolder folder;
  for (const TableFormat format : {TableFormat::Half, TableFormat::Float}) {
    for (const MieStorage mie : {MieStorage::Full, MieStorage::Packed}) {
      for (const bool orders : {false, true}) {
        TableDesc desc = smallDesc();
        desc.format = format;
        desc.mie = mie;
        const TableFile file = makeTables(desc, orders);
        const Done done = writeTableFile(folder / "t.exr", file);
        ASSERT_TRUE(done) << done.error;
        const Result<TableFile> all = readTableFile(folder / "t.exr", true);
        ASSERT_TRUE(all) << all.error;
        expectSame(file, *all, file.parts.size());
        const Result<TableFile> main = readTableFile(folder / "t.exr");
        ASSERT_TRUE(main) << main.error;
        expectSame(file, *main, mie == MieStorage::Full ? 4 : 3);
      }
    }
  }
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST(TableFile, TheSameTablesMakeTheSameBytes) {
  TemporaryFolder folder;
  const TableFile file = makeTables(smallDesc(), true);
  ASSERT_TRUE(writeTableFile(folder / "a.exr", file));
  ASSERT_TRUE(writeTableFile(folder / "b.exr", file));
  EXPECT_EQ(contentsOf(folder / "a.exr"), contentsOf(folder / "b.exr"));
}

TEST(TableFile, PartsAreFoundByName) {
  const TableFile file = makeTables(smallDesc(), true);
  ASSERT_NE(file.find("scattering_order_2"), nullptr);
  EXPECT_EQ(file.find("scattering_order_2")->depth, 2u);
  EXPECT_EQ(file.find("scattering")->width, 6u);  // mu_s x nu
  EXPECT_EQ(file.find("scattering_order_3"), nullptr);
}

TEST(TableFile, UnwritablePlacesAreRefused) {
  TemporaryFolder folder;
  const TableFile file = makeTables(smallDesc(), false);
  for (const std::string& path :
       {folder / "no/t.exr", folder.path(), std::string("/dev/full"), std::string("/proc/t.exr")}) {
    expectSentence(writeTableFile(path, file).error);
  }
  EXPECT_TRUE(folder.names().empty());
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(TableFile, OnlyWholeTablesAreWritten) {
  TemporaryFolder folder;
  const TableFile good = makeTables(smallDesc(), true);
  TableFile bad = good;
  bad.parts.erase(bad.parts.begin() + 1);
  expectSentence(writeTableFile(folder / "t.exr", bad).error);
  bad = good;
  bad.parts[2].texels.pop_back();
  expectSentence(writeTableFile(folder / "t.exr", bad).error);
  bad = good;
  bad.parts.back().name = "irradiance_order_3";
  expectSentence(writeTableFile(folder / "t.exr", bad).error);
  bad = good;
  bad.parts.resize(2);
  expectSentence(writeTableFile(folder / "t.exr", bad).error);
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
  TablePart part = makeTables(smallDesc(), false).parts[1];
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
  EXPECT_TRUE(checkSizes(resolved(TableDesc{})));
  EXPECT_EQ(resolved(TableDesc{}).orders, 5u);
  EXPECT_EQ(scatteringSizeText(resolved(TableDesc{}).sizes), "32x128x32x8");
  TableDesc desc = smallDesc();
  desc.sizes.scatteringMu = 5;
  expectSentence(checkSizes(desc).error);
  desc = smallDesc();
  desc.sizes.irradianceR = 1;
  expectSentence(checkSizes(desc).error);
  desc = smallDesc();
  desc.sizes.scatteringR = desc.sizes.scatteringMuS = desc.sizes.scatteringMu = 4096;
  expectSentence(checkSizes(desc).error);
}

}  // namespace
}  // namespace alpenglow::io
