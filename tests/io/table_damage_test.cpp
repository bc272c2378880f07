// Damaged table files: truncated, altered, of other versions, and altered with a right checksum so
// that the image library sees them. None may crash, none may be taken for whole.
#include <OpenImageIO/hash.h>
#include <alpenglow/io/table_file.h>

#include <cstdio>
#include <cstdlib>
#include <random>

#include "small_table.h"
#include "temporary_folder.h"

namespace alpenglow::io {
namespace {

using test::contentsOf;
using test::makeTables;
using test::smallDescs;
using test::smallMoments;
using test::smallStandard;
using test::TemporaryFolder;

class Damage : public testing::Test {
 protected:
  std::string bytesOf(const TableFile& file) {
    const Done done = writeTableFile(folder_ / "good.exr", file);
    EXPECT_TRUE(done) << done.error;
    return contentsOf(folder_ / "good.exr");
  }
  Result<TableFile> read(const std::string& bytes) {
    return readTableFile(folder_.write("bad.exr", bytes), true);
  }
  void expectRefused(const std::string& bytes, const std::string& mention = "") {
    const Result<TableFile> result = read(bytes);
    ASSERT_FALSE(result);
    test::expectSentence(result.error);
    EXPECT_NE(result.error.find("bad.exr"), std::string::npos) << result.error;
    EXPECT_NE(result.error.find(mention), std::string::npos) << result.error;
  }

  TemporaryFolder folder_;
};

size_t digitsAt(const std::string& bytes) {
  const size_t at = bytes.find(std::string("alpenglow:checksum\0string\0", 26));
  EXPECT_NE(at, std::string::npos);
  return at + 26 + 4;
}

// Written out here once more, so that the file's definition has a second witness.
std::string withChecksum(std::string bytes) {
  const size_t at = digitsAt(bytes);
  bytes.replace(at, 16, 16, '0');
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx",
                OIIO::xxhash::XXH64(bytes.data(), bytes.size(), 0));
  return bytes.replace(at, 16, digits);
}

std::string replaced(std::string bytes, const std::string& from, const std::string& to) {
  EXPECT_EQ(from.size(), to.size());
  const size_t at = bytes.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return bytes.replace(at, to.size(), to);
}

TEST_F(Damage, TheChecksumIsAsDocumented) {
  for (const TableDesc& desc : smallDescs()) {
    const std::string bytes = bytesOf(makeTables(desc, false));
    EXPECT_EQ(withChecksum(bytes), bytes);
  }
}

TEST_F(Damage, EveryPrefixOfASmallFile) {
  for (const TableDesc& desc : smallDescs()) {
    const std::string whole = bytesOf(makeTables(desc, false));
    for (size_t length = 0; length < whole.size(); ++length) {
      expectRefused(whole.substr(0, length));
      if (HasFatalFailure()) return;
    }
    EXPECT_TRUE(read(whole));
  }
}

TEST_F(Damage, EveryByteOfASmallFileAltered) {
  for (const TableDesc& desc : smallDescs()) {
    const std::string whole = bytesOf(makeTables(desc, false));
    for (size_t i = 0; i < whole.size(); ++i) {
      std::string bytes = whole;
      bytes[i] = static_cast<char>(bytes[i] ^ (1 << (i % 8)));
      expectRefused(bytes);
      if (HasFatalFailure()) return;
    }
    expectRefused(whole + '\0');
    expectRefused(whole + whole);
  }
}

TEST_F(Damage, AThousandCutsOfAFullFile) {
  TableDesc desc = smallStandard();
  desc.sizes = {};
  Parameters earth;
  ASSERT_EQ(findPreset("earth", &earth, {}), Status::Ok);
  desc = resolved(desc, earth);
  const std::string whole = bytesOf(makeTables(desc, false));
  std::mt19937_64 random(20261122);
  // Most cuts near the ends, where headers and the last lines are, and the rest anywhere. The file
  // is cut in place, from long to short, since writing a new one each time would take minutes.
  std::vector<size_t> lengths;
  for (int i = 0; i < 1000; ++i) {
    const size_t near = random() % 5000;
    lengths.push_back(i % 4 == 0   ? near
                      : i % 4 == 1 ? whole.size() - 1 - near
                                   : random() % whole.size());
  }
  std::sort(lengths.rbegin(), lengths.rend());
  const std::string path = folder_.write("bad.exr", whole);
  for (const size_t length : lengths) {
    std::filesystem::resize_file(path, length);
    const Result<TableFile> result = readTableFile(path);
    ASSERT_FALSE(result) << length;
    test::expectSentence(result.error);
  }
}

TEST_F(Damage, OtherVersionsAndDescriptions) {
  const std::string whole = bytesOf(makeTables(smallStandard(), false));
  const auto patched = [&](const std::string& from, const std::string& to) {
    return withChecksum(replaced(whole, from, to));
  };
  expectRefused(patched("1.0.0", "0.9.7"), "0.9.7");
  expectRefused(patched("\"mie\"", "\"mia\""), "mia");
  expectRefused(patched("standard", "moments_"), "moments_");
  expectRefused(patched("2x4x3x2", "2x6x3x2"), "shape");
  expectRefused(patched("2x4x3x2", "9x8x9x9"), "shape");
  expectRefused(patched("2x4x3x2", "2x5x3x2"), "even");
  expectRefused(patched("2x4x3x2", "2xhello"), "sizes");
  expectRefused(patched("half", "hulf"), "hulf");
  std::string format = whole;
  const size_t at = format.find(std::string("alpenglow:format\0int\0", 21)) + 25;
  format[at] = kTableFileFormat - 1;
  expectRefused(withChecksum(format), "format " + std::to_string(kTableFileFormat - 1));
  // Another atmosphere is a good file: it is the reader's caller who compares.
  const Result<TableFile> thinner = read(patched("\"top_radius_m\":64", "\"top_radius_m\":63"));
  EXPECT_TRUE(thinner || thinner.error.find("top_radius_m") != std::string::npos);
}

TEST_F(Damage, OtherDescriptionsOfTheMomentSolver) {
  const std::string whole = bytesOf(makeTables(smallMoments(), true));
  const auto patched = [&](const std::string& from, const std::string& to) {
    return withChecksum(replaced(whole, from, to));
  };
  // A description of the other solver belongs to it.
  std::string standard = whole;
  const std::string mark("alpenglow:solver\0string\0\x07\0\0\0moments", 35);
  const size_t at = standard.find(mark);
  ASSERT_NE(at, std::string::npos);
  standard.replace(at, mark.size(), std::string("alpenglow:solver\0string\0\x07\0\0\0standar", 35));
  expectRefused(withChecksum(standard), "solver 'standar'");
  std::string quality = whole;
  const std::string low("alpenglow:quality\0string\0\x03\0\0\0low", 32);
  ASSERT_NE(quality.find(low), std::string::npos);
  quality[quality.find(low) + low.size() - 1] = 'x';
  expectRefused(withChecksum(quality), "quality 'lox'");
  for (const char* setting :
       {"depthMu=4", "depthH=3", "nodesR=2", "nodesMuS=3", "sourceGamma=3", "sourcePsi=2"}) {
    std::string other = setting;
    other.back() = '7';
    expectRefused(patched(setting, other), "shape");
  }
  expectRefused(patched("degree=4", "degree=1"), "degree");
  expectRefused(patched("degree=4", "degree4="), "degree");
  expectRefused(patched("azimuths=5", "azimuths=x"), "azimuths");
  expectRefused(patched("azimuths=5,", "degree=5,,,"), "moment setting");
  expectRefused(patched("solverPanels=2,", "degree=0000003,"), "twice");
}

TEST_F(Damage, AHugeSizeIsRefusedBeforeItIsAllocated) {
  TableDesc desc = smallStandard();
  desc.sizes.scatteringR = 1024;
  const std::string whole = bytesOf(makeTables(desc, false));
  expectRefused(withChecksum(replaced(whole, "1024x4x3x2", "4096x409x4")), "sizes");
  desc = smallMoments();
  desc.sizes.nodesR = desc.sizes.nodesMuS = 10;
  desc.sizes.sourceGamma = desc.sizes.sourcePsi = 10;
  std::string moments = bytesOf(makeTables(desc, false));
  const auto grown = [&](const std::string& setting) {
    moments = replaced(moments, setting + "10", setting + "99");
    return withChecksum(moments);
  };
  for (const char* setting : {"nodesR=", "nodesMuS=", "sourceGamma="}) {
    expectRefused(grown(setting), "shape");
  }
  expectRefused(grown("sourcePsi="), "96059601 texels");
}

// Not all settings give a table its shape. Zeros before a number fill up the place of a setting
// that is left out, so that the attribute keeps its length.
TEST_F(Damage, EverySettingMustBeThere) {
  const std::string whole = bytesOf(makeTables(smallMoments(), false));
  const std::string all = momentSettingsText(smallMoments().sizes);
  for (size_t start = 0; start < all.size();) {
    const size_t end = std::min(all.find(',', start), all.size() - 1);
    const std::string name = all.substr(start, all.find('=', start) - start);
    std::string shortened = all;
    shortened.erase(start, end + 1 - start);
    if (shortened.back() == ',') shortened.pop_back();
    size_t at = 0;
    while (shortened.size() < all.size()) {
      at = shortened.find('=', at + 1);
      if (at == std::string::npos) at = shortened.find('=');
      shortened.insert(at + 1, 1, '0');
    }
    expectRefused(withChecksum(replaced(whole, all, shortened)), name + " is 0");
    start = end + 1;
  }
}

// The image library's turn: random bytes, with a right checksum. A file may also come out readable,
// where only texels or an unread attribute changed. ALPENGLOW_SEED chooses other mutations.
class Mutations : public Damage, public testing::WithParamInterface<Solver> {};

TEST_P(Mutations, WithARightChecksum) {
  const TableFile tables =
      makeTables(GetParam() == Solver::Standard ? smallStandard() : smallMoments(), true);
  const std::string whole = bytesOf(tables);
  const size_t digits = digitsAt(whole);
  const char* seed = std::getenv("ALPENGLOW_SEED");
  std::mt19937 random(seed == nullptr ? 7u : static_cast<uint32_t>(std::atoi(seed)));
  int refused = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string bytes = whole;
    const uint32_t mutations = 1 + random() % 4;
    for (uint32_t i = 0; i < mutations; ++i) {
      // Headers are where harm is done.
      const size_t at = random() % (random() % 2 == 0 ? bytes.size() : bytes.size() / 3);
      const uint32_t kind = random() % 4;
      if (kind == 0) bytes[at] = static_cast<char>(random());
      if (kind == 1) bytes[at] = static_cast<char>(bytes[at] ^ (1 << random() % 8));
      if (kind == 2) bytes[at] = static_cast<char>(random() % 2 == 0 ? 0xFF : 0x7F);
      if (kind == 3) {
        for (size_t k = at; k < std::min(at + 4, bytes.size()); ++k) {
          bytes[k] = static_cast<char>(random());
        }
      }
    }
    if (round % 5 == 0) bytes.resize(digits + 16 + random() % (bytes.size() - digits - 16));
    if (bytes.compare(digits - 30, 30, whole, digits - 30, 30) != 0) continue;
    const Result<TableFile> result = read(withChecksum(bytes));
    if (result) continue;
    ++refused;
    test::expectSentence(result.error);
  }
  EXPECT_GT(refused, 1300);
}

INSTANTIATE_TEST_SUITE_P(OfEachSolver, Mutations,
                         testing::Values(Solver::Standard, Solver::Moments),
                         [](const auto& solver) { return solverName(solver.param); });

}  // namespace
}  // namespace alpenglow::io
