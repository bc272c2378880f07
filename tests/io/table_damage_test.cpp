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
using test::smallDesc;
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
  const std::string bytes = bytesOf(makeTables(smallDesc(), false));
  EXPECT_EQ(withChecksum(bytes), bytes);
}

TEST_F(Damage, EveryPrefixOfASmallFile) {
  const std::string whole = bytesOf(makeTables(smallDesc(), false));
  for (size_t length = 0; length < whole.size(); ++length) {
    expectRefused(whole.substr(0, length));
    if (HasFatalFailure()) return;
  }
  EXPECT_TRUE(read(whole));
}

TEST_F(Damage, EveryByteOfASmallFileAltered) {
  const std::string whole = bytesOf(makeTables(smallDesc(), false));
  for (size_t i = 0; i < whole.size(); ++i) {
    std::string bytes = whole;
    bytes[i] = static_cast<char>(bytes[i] ^ (1 << (i % 8)));
    expectRefused(bytes);
    if (HasFatalFailure()) return;
  }
  expectRefused(whole + '\0');
  expectRefused(whole + whole);
}

TEST_F(Damage, AThousandCutsOfAFullFile) {
  const std::string whole = bytesOf(makeTables(resolved(TableDesc{}), false));
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
  const std::string whole = bytesOf(makeTables(smallDesc(), false));
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
  format[at] = 2;
  expectRefused(withChecksum(format), "format 2");
  // Another atmosphere is a good file: it is the reader's caller who compares.
  const Result<TableFile> thinner = read(patched("\"top_radius_m\":64", "\"top_radius_m\":63"));
  EXPECT_TRUE(thinner || thinner.error.find("top_radius_m") != std::string::npos);
}

TEST_F(Damage, AHugeSizeIsRefusedBeforeItIsAllocated) {
  TableDesc desc = smallDesc();
  desc.sizes.scatteringR = 1024;
  const std::string whole = bytesOf(makeTables(desc, false));
  expectRefused(withChecksum(replaced(whole, "1024x4x3x2", "4096x409x4")), "sizes");
}

// The image library's turn: random bytes, with a right checksum. A file may also come out readable,
// where only texels or an unread attribute changed. ALPENGLOW_SEED chooses other mutations.
TEST_F(Damage, RandomMutationsWithARightChecksum) {
  const TableFile tables = makeTables(smallDesc(), true);
  const std::string whole = bytesOf(tables);
  const size_t digits = digitsAt(whole);
  const char* seed = std::getenv("ALPENGLOW_SEED");
  std::mt19937 random(seed == nullptr ? 7u : static_cast<uint32_t>(std::atoi(seed)));
  int refused = 0;
  for (int round = 0; round < 6000; ++round) {
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
  EXPECT_GT(refused, 2000);
}

}  // namespace
}  // namespace alpenglow::io
