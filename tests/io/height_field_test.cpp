#include <OpenImageIO/imageio.h>
#include <alpenglow/io/height_field.h>
#include <alpenglow/io/image_file.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "temporary_folder.h"

namespace alpenglow::io {
namespace {

using test::contentsOf;
using test::expectSentence;
using test::TemporaryFolder;

using Hints = std::initializer_list<std::pair<const char*, int>>;

template <typename T>
std::string written(const std::string& path, int width, int height, int channels,
                    const std::vector<T>& samples, Hints hints = {},
                    OIIO::TypeDesc stored = OIIO::BaseTypeFromC<T>::value) {
  OIIO::ImageSpec spec(width, height, channels, stored);
  for (const auto& [name, value] : hints) spec.attribute(name, value);
  const auto output = OIIO::ImageOutput::create(path);
  EXPECT_TRUE(output && output->open(path, spec) &&
              output->write_image(OIIO::BaseTypeFromC<T>::value, samples.data()) && output->close())
      << path;
  return path;
}

std::vector<float> heightsOf(const std::string& path, const HeightUnits& units = {}) {
  const Result<HeightMap> map = readHeightMap(path, units);
  EXPECT_TRUE(map) << map.error;
  return map ? map->heights_m : std::vector<float>{};
}

void expectRefused(const std::string& path, std::initializer_list<const char*> words) {
  const Result<HeightMap> map = readHeightMap(path);
  EXPECT_FALSE(map);
  expectSentence(map.error);
  for (const char* word : words) EXPECT_NE(map.error.find(word), std::string::npos) << map.error;
}

TEST(HeightMap, IntegersAreTheirOwnUnit) {
  TemporaryFolder folder;
  const std::vector<float> expected = {0, 1, 255, 7, 8, 100};
  const auto bytes = written<uint8_t>(folder / "a.png", 3, 2, 1, {0, 1, 255, 7, 8, 100});
  EXPECT_EQ(heightsOf(bytes), expected);
  const Result<HeightMap> map = readHeightMap(bytes);
  EXPECT_EQ(map->width, 3u);
  EXPECT_EQ(map->height, 2u);
  const auto words = written<uint16_t>(folder / "b.png", 2, 2, 1, {0, 65535, 300, 1});
  EXPECT_EQ(heightsOf(words), (std::vector<float>{0, 65535, 300, 1}));
  EXPECT_EQ(heightsOf(written<int16_t>(folder / "c.tif", 2, 2, 1, {-32768, 32767, -5, 0})),
            (std::vector<float>{-32768, 32767, -5, 0}));
  EXPECT_EQ(heightsOf(written<uint32_t>(folder / "d.tif", 2, 2, 1, {0, 4000000000u, 16777216, 3})),
            (std::vector<float>{0, 4e9f, 16777216, 3}));
  EXPECT_EQ(heightsOf(written<uint8_t>(folder / "e.tif", 3, 2, 1, {0, 1, 255, 7, 8, 100})),
            expected);
}

TEST(HeightMap, FloatsKeepEveryBit) {
  TemporaryFolder folder;
  const std::vector<float> heights = {-11000.5f, 8848.86f, 1e-20f, 0.0f, 3.0f, 1.0f / 3.0f};
  EXPECT_EQ(heightsOf(written<float>(folder / "a.exr", 3, 2, 1, heights)), heights);
  EXPECT_EQ(heightsOf(written<float>(folder / "a.tif", 2, 3, 1, heights)), heights);
  const std::vector<float> halves = {1000.5f, -3.25f, 0.0f, 2.0f};
  EXPECT_EQ(heightsOf(written(folder / "b.exr", 2, 2, 1, halves, {}, OIIO::TypeDesc::HALF)),
            halves);
  EXPECT_EQ(heightsOf(written<double>(folder / "b.tif", 2, 2, 1, {0.5, 1e10, -2, 0.1})),
            (std::vector<float>{0.5f, 1e10f, -2.0f, 0.1f}));
}

TEST(HeightMap, OnlyTheFirstChannelCountsAndAlphaDoesNot) {
  TemporaryFolder folder;
  const std::vector<uint16_t> grey = {1000, 0, 2000, 1, 3000, 300, 4000, 65535};
  const std::vector<float> expected = {1000, 2000, 3000, 4000};
  for (const char* name : {"a.png", "a.tif"}) {
    EXPECT_EQ(
        heightsOf(written<uint16_t>(folder / name, 2, 2, 2, grey, {{"oiio:UnassociatedAlpha", 1}})),
        expected)
        << name;
  }
  const std::vector<uint8_t> colours = {9, 1, 1, 8, 2, 2, 7, 3, 3, 6, 4, 4};
  for (const char* name : {"b.png", "b.tif"}) {
    EXPECT_EQ(heightsOf(written<uint8_t>(folder / name, 2, 2, 3, colours)),
              (std::vector<float>{9, 8, 7, 6}))
        << name;
  }
}

TEST(HeightMap, ScalesAndMovesInMetres) {
  TemporaryFolder folder;
  const std::string path = written<uint16_t>(folder / "a.png", 2, 2, 1, {0, 10, 20, 65535});
  EXPECT_EQ(heightsOf(path, {0.5, -100.0}), (std::vector<float>{-100, -95, -90, 32667.5f}));
  const double infinity = std::numeric_limits<double>::infinity();
  for (const HeightUnits& units :
       {HeightUnits{0.0, 0.0}, HeightUnits{-1.0, 0.0}, HeightUnits{infinity, 0.0},
        HeightUnits{1.0, infinity}, HeightUnits{std::nan(""), 0.0}, HeightUnits{1e300, 0.0}}) {
    const Result<HeightMap> map = readHeightMap(path, units);
    EXPECT_FALSE(map);
    expectSentence(map.error);
  }
}

TEST(HeightMap, ReadsTheCumberlandMountains) {
  const Result<HeightMap> map = readHeightMap(ALPENGLOW_HEIGHT_MAP);
  ASSERT_TRUE(map) << map.error;
  EXPECT_EQ(map->width, 403u);
  EXPECT_EQ(map->height, 344u);
  const auto [least, most] = std::minmax_element(map->heights_m.begin(), map->heights_m.end());
  EXPECT_EQ(*least, 236.0f);
  EXPECT_EQ(*most, 1076.0f);
  EXPECT_EQ(map->heights_m[0], 483.0f);  // The source's north-west corner, and the next row's.
  EXPECT_EQ(map->heights_m[403], 475.0f);
}

TEST(HeightMap, NamesThePlaceOfWhatIsNotFinite) {
  TemporaryFolder folder;
  std::vector<float> heights(20, 1.0f);
  heights[5 + 3] = std::numeric_limits<float>::quiet_NaN();
  expectRefused(written<float>(folder / "a.exr", 5, 4, 1, heights), {"column 3, row 1", "nan"});
  heights[5 + 3] = -std::numeric_limits<float>::infinity();
  expectRefused(written<float>(folder / "a.tif", 5, 4, 1, heights), {"column 3, row 1", "-inf"});
}

TEST(HeightMap, RefusesWhatIsNoHeightMap) {
  TemporaryFolder folder;
  expectRefused(folder / "absent.png", {"absent.png"});
  expectRefused(folder.path(), {});
  expectRefused(folder.write("a.png", ""), {"no PNG, TIFF or EXR image"});
  expectRefused(folder.write("b.png", "hello"), {"no PNG, TIFF or EXR image"});
  expectRefused(ALPENGLOW_EARTH_MAP, {"no PNG, TIFF or EXR image"});
  expectRefused(written<uint8_t>(folder / "one.png", 1, 1, 1, {3}), {"1x1", "2x2"});
  expectRefused(written<uint8_t>(folder / "row.png", 5, 1, 1, {3, 3, 3, 3, 3}), {"5x1", "2x2"});
  expectRefused(written<uint8_t>(folder / "bits.tif", 8, 2, 1, std::vector<uint8_t>(16, 255),
                                 {{"oiio:BitsPerSample", 1}}),
                {"1 bits a sample"});
}

// CRC-32 of ISO 3309, as PNG prescribes.
uint32_t crcOf(const std::string& bytes) {
  uint32_t crc = 0xFFFFFFFFu;
  for (const char byte : bytes) {
    crc ^= static_cast<uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? 0xEDB88320u ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

std::string bigEndian(uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xFF);
  return bytes;
}

/// A good PNG whose header then says something else.
std::string pngThatClaims(const std::string& png, uint32_t width, uint32_t height, char bits,
                          char colour) {
  std::string changed = png;
  std::string header = bigEndian(width) + bigEndian(height) + bits + colour;
  changed.replace(16, header.size(), header);
  changed.replace(29, 4, bigEndian(crcOf(changed.substr(12, 17))));
  return changed;
}

TEST(HeightMap, TheSizeIsCheckedBeforeTheSamplesAreRead) {
  TemporaryFolder folder;
  const std::string good =
      contentsOf(written<uint16_t>(folder / "good.png", 2, 2, 1, {1, 2, 3, 4}));
  const auto claims = [&](uint32_t width, uint32_t height, char bits, char colour) {
    return folder.write("claim.png", pngThatClaims(good, width, height, bits, colour));
  };
  EXPECT_EQ(heightsOf(claims(2, 2, 16, 0)).size(), 4u);
  expectRefused(claims(20000, 20000, 16, 0), {"20000x20000", "8192", "16777216"});
  expectRefused(claims(8193, 2, 16, 0), {"8193x2"});
  expectRefused(claims(8192, 2049, 16, 0), {"8192x2049"});
  expectRefused(claims(8192, 2048, 16, 0), {"Cannot read"});  // The size is fine, the rest missing.
  expectRefused(claims(2, 2, 4, 0), {"4 bits a sample"});
  const std::string tall =
      written<uint8_t>(folder / "tall.tif", 2, 8193, 1, std::vector<uint8_t>(2 * 8193, 1));
  expectRefused(tall, {"2x8193"});
  const std::string wide =
      written<float>(folder / "wide.exr", 8193, 2, 1, std::vector<float>(2 * 8193, 1.0f));
  expectRefused(wide, {"8193x2"});
}

// Whatever is cut off or altered, there is a sentence or a map with finite heights, and no crash.
TEST(HeightMap, SurvivesDamage) {
  TemporaryFolder folder;
  std::vector<uint16_t> words(40 * 30);
  std::vector<float> floats(40 * 30);
  for (size_t i = 0; i < words.size(); ++i) {
    words[i] = static_cast<uint16_t>(i * 37);
    floats[i] = static_cast<float>(i) * 0.37f;
  }
  const std::string files[] = {
      written(folder / "a.png", 40, 30, 1, words), written(folder / "a.tif", 40, 30, 1, words),
      written(folder / "b.tif", 40, 30, 1, floats), written(folder / "a.exr", 40, 30, 1, floats)};
  std::mt19937 random(1);
  const auto check = [&](const std::string& bytes, bool mustFail, const std::string& what) {
    const Result<HeightMap> map = readHeightMap(folder.write("damaged", bytes));
    EXPECT_FALSE(map && mustFail) << what;
    if (!map) {
      expectSentence(map.error);
      return;
    }
    EXPECT_EQ(map->heights_m.size(), size_t{map->width} * map->height) << what;
    EXPECT_TRUE(std::all_of(map->heights_m.begin(), map->heights_m.end(),
                            [](float height) { return std::isfinite(height); }));
  };
  for (const std::string& file : files) {
    const std::string good = contentsOf(file);
    const bool tiff = file.back() == 'f';
    for (size_t length = 0; length < good.size(); length += 1 + length / 40) {
      check(good.substr(0, length), !tiff, file + " cut at " + std::to_string(length));
    }
    for (int round = 0; round < 300; ++round) {
      std::string bad = good;
      const size_t reach = round % 2 == 0 ? bad.size() : std::min<size_t>(bad.size(), 400);
      for (int flips = 0; flips < 1 + round % 4; ++flips) {
        // A TIFF's directory stands at its end.
        const size_t at = random() % reach;
        const size_t place = tiff && round % 2 != 0 ? bad.size() - 1 - at : at;
        bad[place] = static_cast<char>(random());
      }
      check(bad, false, file + " altered in round " + std::to_string(round));
    }
  }
}

}  // namespace
}  // namespace alpenglow::io
