// The figures of the report, on numbers that can be checked by hand.
#include <alpenglow/cost.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "atmosphere/cost/configurations.h"
#include "atmosphere/cost/difference.h"
#include "atmosphere/cost/page.h"
#include "atmosphere/cost/shared_exponent.h"

namespace alpenglow::cost {
namespace {

TEST(Statistics, MediansAndSpread) {
  const Timing odd = timingOf({3.0, 1.0, 2.0});
  EXPECT_EQ(odd.median, 2.0);
  EXPECT_EQ(odd.least, 1.0);
  EXPECT_EQ(odd.most, 3.0);
  EXPECT_EQ(odd.runs, 3u);
  EXPECT_EQ(timingOf({4.0, 1.0}).median, 2.5);
  EXPECT_EQ(timingOf({}).runs, 0u);
}

TEST(Statistics, TheFrontHoldsUndominatedRows) {
  const std::vector<double> x = {1.0, 2.0, 3.0, 4.0, 2.0, 0.0}, y = {9.0, 5.0, 6.0, 1.0, 4.0, 0.5};
  EXPECT_EQ(paretoFront(x, y), (std::vector<size_t>{0, 4, 3}));  // 5 is not above 0
  EXPECT_TRUE(paretoFront({}, {}).empty());
  EXPECT_EQ(paretoFront({1.0, 1.0}, {2.0, 2.0}).size(), 1u);
}

TEST(SharedExponent, PacksAsVulkanDoes) {
  const float one[3] = {1.0f, 0.5f, 0.25f};
  EXPECT_EQ(packSharedExponent(one), 16u << 27 | 64u << 18 | 128u << 9 | 256u);
  float back[3];
  unpackSharedExponent(packSharedExponent(one), back);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(back[i], one[i]);
  // 0.9995 rounds up to 512 mantissa steps and takes the next exponent.
  const float high[3] = {0.9995f, 0.0f, -3.0f};
  unpackSharedExponent(packSharedExponent(high), back);
  EXPECT_EQ(back[0], 1.0f);
  EXPECT_EQ(back[1], 0.0f);
  EXPECT_EQ(back[2], 0.0f);
  const float wild[3] = {1e9f, std::numeric_limits<float>::quiet_NaN(), 1e-9f};
  unpackSharedExponent(packSharedExponent(wild), back);
  EXPECT_EQ(back[0], 65408.0f);
  EXPECT_EQ(back[1], 0.0f);
  EXPECT_EQ(back[2], 0.0f);
}

TEST(SharedExponent, KeepsEightBits) {
  for (float value = 1e-3f; value < 6e4f; value *= 1.7f) {
    const float rgb[3] = {value, 0.8f * value, 0.6f * value};
    float back[3];
    unpackSharedExponent(packSharedExponent(rgb), back);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(back[i], rgb[i], value / 511.0f);
  }
}

TEST(Difference, IsBlueWhereDarkerAndNotHiddenByTheSun) {
  io::LinearImage finest{20, 10, std::vector<float>(600, 0.02f)};
  std::fill_n(finest.pixels.begin(), 3, 14000.0f);  // the sun's disc
  io::LinearImage image = finest;
  std::fill_n(image.pixels.begin() + 3, 3, 0.01f);
  std::fill_n(image.pixels.begin() + 6, 3, 0.04f);
  const io::ByteImage difference = differenceOf(image, finest);
  const auto pixel = [&](size_t i) {
    const auto* p = &difference.pixels[3 * i];
    return std::array<int, 3>{p[0], p[1], p[2]};
  };
  const std::array<int, 3> white{255, 255, 255};
  EXPECT_EQ(pixel(0), white);
  EXPECT_EQ(pixel(3), white);
  EXPECT_LT(pixel(1)[0], 60);  // half as bright
  EXPECT_GT(pixel(1)[2], 200);
  EXPECT_GT(pixel(2)[0], 200);  // twice as bright
  EXPECT_LT(pixel(2)[2], 60);
  EXPECT_EQ(differenceOf({2, 1, std::vector<float>(6)}, {2, 1, std::vector<float>(6)}).pixels,
            std::vector<uint8_t>(6, 255));  // nothing in either
}

TEST(Configurations, NamesAreUniqueAndQuickIsShorter) {
  const auto all = configurations(false), quick = configurations(true);
  EXPECT_GT(all.size(), quick.size() + 10);
  for (const auto* list : {&all, &quick}) {
    for (size_t i = 0; i < list->size(); ++i)
      for (size_t j = 0; j < i; ++j)
        EXPECT_FALSE((*list)[i].sweep == (*list)[j].sweep && (*list)[i].name == (*list)[j].name)
            << (*list)[i].name;
  }
}

Row row(const char* name, const char* family, double frame, double error) {
  Row row;
  row.sweep = "model";
  row.name = name;
  row.family = family;
  row.bytes = 1;
  for (uint32_t i = 0; i < kGroundViews; ++i) row.frame_ms[i] = {frame, frame, frame, 1};
  for (uint32_t band = 0; band < 4; ++band) row.errors[band] = {error, error, 10};
  return row;
}

TEST(Exceptions, AreRowsBetterThanMoments) {
  Report report;
  report.rows = {row("moments", "moments", 20.0, 0.01),   row("draft", "moments", 8.0, 0.05),
                 row("slow and bad", "oneil", 50.0, 0.5), row("fast", "standard", 5.0, 0.1),
                 row("good", "hillaire", 10.0, 0.03),     row("rounded", "moments", 1.0, 0.001)};
  report.rows.back().sweep = "storage";  // no setting of ours
  const std::vector<Exception> exceptions = exceptionsOf(report);
  ASSERT_EQ(exceptions.size(), 8u);  // two rivals in four bands
  EXPECT_EQ(exceptions[0].name, "fast");
  EXPECT_EQ(exceptions[0].best, 0.0);  // nothing of moments is as fast
  EXPECT_EQ(exceptions[4].name, "good");
  EXPECT_EQ(exceptions[4].best, 0.05);
}

}  // namespace
}  // namespace alpenglow::cost
