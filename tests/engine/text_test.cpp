// Sentences: as printf has them in the C locale.
#include "engine/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

namespace alpenglow::engine {
namespace {

std::string text(size_t size, const char* format, ...) __attribute__((format(printf, 2, 3)));
std::string text(size_t size, const char* format, ...) {
  std::string out(size, '#');
  std::va_list arguments;
  va_start(arguments, format);
  formatText(out.data(), size, format, arguments);
  va_end(arguments);
  EXPECT_NE(out.find('\0'), std::string::npos);
  return out.c_str();
}

TEST(Text, IntegersAndStringsAreThoseOfPrintf) {
  EXPECT_EQ(text(99, "plain"), "plain");
  EXPECT_EQ(text(99, "%s is %d, not %u; 100 %%", "x", -3, 4000000000u),
            "x is -3, not 4000000000; 100 %");
  EXPECT_EQ(text(99, "0x%x %llx", 0xBEEFu, 0x123456789ABCDEFull), "0xbeef 123456789abcdef");
  EXPECT_EQ(text(99, "%lld %llu %ld %lu %zu", -5ll, 18446744073709551615ull, -6l, 7ul, size_t{8}),
            "-5 18446744073709551615 -6 7 8");
}

TEST(Text, NumbersAreThoseOfPrintf) {
  std::mt19937_64 random(7);
  const auto expectSame = [](double value) {
    char expected[64];
    std::snprintf(expected, sizeof expected, "%g", value);
    EXPECT_EQ(text(64, "%g", value), expected);
  };
  for (const double value :
       {0.0, -0.0, 1.0, -1.5, 1e-5, 1e-4, 123456.0, 1234567.0, 1e300, 5e-324, 0.1, 6.36e6,
        2.0 / 3.0, std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    expectSame(value);
  for (int i = 0; i < 20000; ++i) {
    const double mantissa = std::uniform_real_distribution(-10.0, 10.0)(random);
    expectSame(std::ldexp(mantissa, int(random() % 200) - 100));
  }
}

// The buffer is never overrun, and always terminated.
TEST(Text, WhatDoesNotFitIsCutOff) {
  const std::string whole = text(99, "abc %d %g %s", 12345, 0.25, "xyz");
  for (size_t size = 1; size < whole.size() + 3; ++size)
    EXPECT_EQ(text(size, "abc %d %g %s", 12345, 0.25, "xyz"), whole.substr(0, size - 1)) << size;
}

}  // namespace
}  // namespace alpenglow::engine
