#include <alpenglow/io/tone_map.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace alpenglow::io {
namespace {

LinearImage filled(uint32_t width, uint32_t height, float value) {
  return {width, height, std::vector<float>(size_t{width} * height * 3, value)};
}

void paint(LinearImage* image, size_t first, size_t count, float value) {
  std::fill_n(image->pixels.begin() + static_cast<std::ptrdiff_t>(first * 3), count * 3, value);
}

TEST(AutomaticExposure, BringsTheTypicalPixelToMiddleGrey) {
  EXPECT_NEAR(automaticExposure(filled(40, 30, 0.01f)), 20.0, 1e-4);
  EXPECT_NEAR(automaticExposure(filled(40, 30, 1e-8f)), 2e7, 1e2);
  LinearImage halves = filled(40, 30, 0.01f);
  paint(&halves, 0, 600, 0.04f);
  EXPECT_NEAR(automaticExposure(halves), 10.0, 0.01);
}

TEST(AutomaticExposure, IgnoresSpaceBordersNightSidesAndTheDisc) {
  LinearImage image = filled(100, 100, 0.01f);
  const double plain = automaticExposure(image);
  paint(&image, 0, 6000, 0.0f);      // black space
  paint(&image, 6000, 1500, 1e-6f);  // a night side
  paint(&image, 9980, 20, 5e3f);     // a sun disc
  EXPECT_NEAR(automaticExposure(image), plain, 1e-6 * plain);
}

TEST(AutomaticExposure, IsAlwaysFiniteAndClamped) {
  EXPECT_EQ(automaticExposure(filled(10, 10, 0.0f)), 1.0);
  EXPECT_EQ(automaticExposure(LinearImage{}), 1.0);
  EXPECT_EQ(automaticExposure(filled(10, 10, 1e-30f)), 1e12);
  EXPECT_EQ(automaticExposure(filled(10, 10, 1e30f)), 1e-9);
  EXPECT_EQ(automaticExposure(filled(10, 10, std::nanf(""))), 1.0);
}

TEST(AutomaticExposure, DoesNotBurnTheWhites) {
  LinearImage image = filled(100, 100, 0.02f);
  paint(&image, 0, 1000, 1.0f);
  EXPECT_LE(automaticExposure(image) * 1.0, 4.0 + 1e-6);
}

TEST(ToneMapped, EndsAreExact) {
  for (const ToneMap map : {ToneMap::Filmic, ToneMap::Reinhard, ToneMap::Linear}) {
    for (const uint8_t level : toneMapped(filled(64, 64, 0.0f), 1.0, map).pixels) {
      ASSERT_EQ(level, 0);
    }
  }
  for (const uint8_t level : toneMapped(filled(64, 64, 2.0f), 1.0, ToneMap::Linear).pixels) {
    ASSERT_EQ(level, 255);
  }
  for (const float odd : {-1.0f, std::nanf("")}) {
    for (const uint8_t level : toneMapped(filled(8, 8, odd), 1.0, ToneMap::Linear).pixels) {
      ASSERT_EQ(level, 0);
    }
  }
  const float infinity = std::numeric_limits<float>::infinity();
  for (const uint8_t level : toneMapped(filled(8, 8, infinity), 1.0, ToneMap::Linear).pixels) {
    ASSERT_EQ(level, 255);
  }
}

TEST(ToneMapped, IsSrgbOnAverageAndRepeats) {
  const LinearImage image = filled(128, 128, 0.2f);
  const ByteImage bytes = toneMapped(image, 1.5, ToneMap::Linear);
  EXPECT_EQ(bytes.pixels, toneMapped(image, 1.5, ToneMap::Linear).pixels);
  double sum = 0.0;
  for (const uint8_t level : bytes.pixels) sum += level;
  const double expected = 255.0 * (1.055 * std::pow(0.3, 1.0 / 2.4) - 0.055);
  // A uniform dither of one step over n values: the mean is off by at most about 4 / sqrt(12 n).
  EXPECT_NEAR(sum / static_cast<double>(bytes.pixels.size()), expected + 0.0, 0.01);
}

// A ramp over less than one 8-bit step would be one or two flat bands without a dither.
TEST(ToneMapped, ARampDoesNotBand) {
  LinearImage image = filled(512, 64, 0.0f);
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      for (uint32_t c = 0; c < 3; ++c) {
        image.pixels[(size_t{y} * image.width + x) * 3 + c] =
            0.2f + 0.0015f * static_cast<float>(x) / 512.0f;
      }
    }
  }
  const ByteImage bytes = toneMapped(image, 1.0, ToneMap::Linear);
  double previous = 0.0;
  for (uint32_t block = 0; block < 8; ++block) {
    double mean = 0.0;
    for (uint32_t y = 0; y < 64; ++y) {
      for (uint32_t x = 0; x < 64; ++x) {
        mean += bytes.pixels[(size_t{y} * 512 + block * 64 + x) * 3] / 4096.0;
      }
    }
    if (block > 0) {
      EXPECT_GT(mean, previous) << block;
    }
    previous = mean;
  }
}

TEST(ToneMapped, EveryMapRisesAndKnowsItsName) {
  EXPECT_EQ(toneMapNames(), (std::vector<std::string>{"filmic", "reinhard", "linear"}));
  for (const ToneMap map : {ToneMap::Filmic, ToneMap::Reinhard, ToneMap::Linear}) {
    int previous = -1;
    for (float value = 0.01f; value < 0.9f; value *= 1.6f) {
      const int level = toneMapped(filled(1, 1, value), 1.0, map).pixels[0];
      EXPECT_GT(level, previous);
      previous = level;
    }
  }
}

}  // namespace
}  // namespace alpenglow::io
