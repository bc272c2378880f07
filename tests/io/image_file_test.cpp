#include <alpenglow/io/image_file.h>

#include <cmath>

#include "temporary_folder.h"

namespace alpenglow::io {
namespace {

using test::contentsOf;
using test::expectSentence;
using test::TemporaryFolder;

LinearImage gradient(uint32_t width, uint32_t height) {
  LinearImage image{width, height, {}};
  for (uint32_t i = 0; i < width * height * 3; ++i) {
    image.pixels.push_back(1e-6f * static_cast<float>(i * i) + 1e-12f);
  }
  return image;
}

ByteImage bytesOf(uint32_t width, uint32_t height) {
  ByteImage image{width, height, {}};
  for (uint32_t i = 0; i < width * height * 3; ++i) {
    image.pixels.push_back(static_cast<uint8_t>(i * 7));
  }
  return image;
}

TEST(ImageFile, ExrKeepsEveryBit) {
  TemporaryFolder folder;
  const LinearImage image = gradient(37, 21);
  ASSERT_TRUE(writeExr(folder / "a.exr", image));
  const Result<LinearImage> again = readExr(folder / "a.exr");
  ASSERT_TRUE(again) << again.error;
  EXPECT_EQ(again->width, 37u);
  EXPECT_EQ(again->height, 21u);
  EXPECT_EQ(again->pixels, image.pixels);
  const std::string bytes = contentsOf(folder / "a.exr");
  ASSERT_TRUE(writeExr(folder / "a.exr", image));
  EXPECT_EQ(contentsOf(folder / "a.exr"), bytes);
}

TEST(ImageFile, PngIsEightBitSrgbWithoutAlpha) {
  TemporaryFolder folder;
  ASSERT_TRUE(writePng(folder / "a.png", bytesOf(16, 8)));
  const std::string bytes = contentsOf(folder / "a.png");
  ASSERT_GT(bytes.size(), 33u);
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  EXPECT_EQ(bytes[24], 8);  // Bits a channel.
  EXPECT_EQ(bytes[25], 2);  // RGB.
  const Result<AlbedoMap> again = readAlbedoMap(folder / "a.png");
  ASSERT_TRUE(again) << again.error;
  const AlbedoMap::Level& level = again->levels[0];
  const ByteImage image = bytesOf(16, 8);
  for (size_t i = 0; i < 16 * 8; ++i) {
    for (size_t c = 0; c < 3; ++c) EXPECT_EQ(level.rgba[i * 4 + c], image.pixels[i * 3 + c]);
    EXPECT_EQ(level.rgba[i * 4 + 3], 255);
  }
}

TEST(ImageFile, UnwritablePlacesAreRefused) {
  TemporaryFolder folder;
  for (const std::string& path :
       {folder / "no/such.exr", folder.path(), std::string("/dev/full")}) {
    expectSentence(writeExr(path, gradient(64, 64)).error);
    expectSentence(writePng(path, bytesOf(64, 64)).error);
  }
  EXPECT_TRUE(folder.names().empty());
}

TEST(AlbedoMap, MipLevelsAreMeansInLinearLight) {
  AlbedoMap map;
  AlbedoMap::Level level{8, 4, std::vector<uint8_t>(8 * 4 * 4, 255)};
  for (size_t i = 0; i < 8 * 4; ++i) {  // Columns of black and white.
    for (size_t c = 0; c < 3; ++c) level.rgba[i * 4 + c] = i % 2 == 0 ? 0 : 255;
  }
  map.levels.push_back(level);
  addMipLevels(&map);
  ASSERT_EQ(map.levels.size(), 4u);
  EXPECT_EQ(map.levels[1].width, 4u);
  EXPECT_EQ(map.levels[1].height, 2u);
  EXPECT_EQ(map.levels[3].width, 1u);
  EXPECT_EQ(map.levels[3].height, 1u);
  for (size_t i = 1; i < 4; ++i) EXPECT_EQ(map.levels[i].rgba[0], 188) << i;  // sRGB of 0.5.
}

TEST(AlbedoMap, EveryLevelKeepsEveryGrey) {
  for (uint32_t grey = 0; grey < 256; ++grey) {
    AlbedoMap map;
    map.levels.push_back({5, 3, std::vector<uint8_t>(5 * 3 * 4, static_cast<uint8_t>(grey))});
    addMipLevels(&map);
    for (const AlbedoMap::Level& level : map.levels) {
      ASSERT_EQ(level.rgba.size(), size_t{level.width} * level.height * 4);
      ASSERT_EQ(level.rgba[0], grey);
    }
  }
}

TEST(AlbedoMap, LinearExrBecomesSrgb) {
  TemporaryFolder folder;
  LinearImage image{2, 1, {0.5f, 0.0f, 7.0f, -1.0f, 1.0f, 0.2f}};
  ASSERT_TRUE(writeExr(folder / "a.exr", image));
  const Result<AlbedoMap> map = readAlbedoMap(folder / "a.exr");
  ASSERT_TRUE(map) << map.error;
  const std::vector<uint8_t> expected = {188, 0, 255, 255, 0, 255, 124, 255};
  EXPECT_EQ(map->levels[0].rgba, expected);
}

TEST(AlbedoMap, ReadsTheEarth) {
  const Result<AlbedoMap> map = readAlbedoMap(ALPENGLOW_EARTH_MAP);
  ASSERT_TRUE(map) << map.error;
  EXPECT_EQ(map->levels[0].width, 2 * map->levels[0].height);
}

TEST(AlbedoMap, RefusesWhatIsNoPicture) {
  TemporaryFolder folder;
  expectSentence(readAlbedoMap(folder / "absent.png").error);
  expectSentence(readAlbedoMap(folder.write("a.jpg", "hello")).error);
  expectSentence(readAlbedoMap(folder.write("b.jpg", "")).error);
  ASSERT_TRUE(writePng(folder / "c.png", bytesOf(64, 64)));
  ASSERT_TRUE(writeExr(folder / "d.exr", gradient(64, 64)));
  const std::string png = contentsOf(folder / "c.png");
  const std::string exr = contentsOf(folder / "d.exr");
  for (size_t length = 0; length < 60; ++length) {
    expectSentence(readAlbedoMap(folder.write("cut", png.substr(0, length))).error);
    expectSentence(readAlbedoMap(folder.write("cut", exr.substr(0, length))).error);
  }
  expectSentence(readAlbedoMap(folder.write("cut", png.substr(0, png.size() / 2))).error);
  const std::string jpeg = contentsOf(ALPENGLOW_EARTH_MAP);
  for (const size_t length : {size_t{100}, jpeg.size() / 2, jpeg.size() - 2}) {
    expectSentence(readAlbedoMap(folder.write("cut", jpeg.substr(0, length))).error);
  }
  expectSentence(readAlbedoMap(folder.write("cut", exr.substr(0, exr.size() / 2))).error);
}

TEST(AlbedoMap, TheSizeIsCheckedFirst) {
  TemporaryFolder folder;
  ASSERT_TRUE(writePng(folder / "wide.png", bytesOf(kMaxAlbedoWidth + 1, 1)));
  const std::string error = readAlbedoMap(folder / "wide.png").error;
  expectSentence(error);
  EXPECT_NE(error.find("16385x1"), std::string::npos) << error;
  EXPECT_NE(error.find("16384x8192"), std::string::npos) << error;
}

}  // namespace
}  // namespace alpenglow::io
