#include "atmosphere/cost/shared_exponent.h"

#include <algorithm>
#include <cmath>

namespace alpenglow::cost {
namespace {

constexpr int kMantissaBits = 9, kBias = 15, kMostExponent = 31;
constexpr float kGreatest = 65408.0f;  // 511 / 512 * 2^(31 - 15)

}  // namespace

// VK spec, "Shared exponent to RGB".
uint32_t packSharedExponent(const float rgb[3]) {
  float clamped[3], most = 0.0f;
  for (int i = 0; i < 3; ++i) {
    clamped[i] = rgb[i] > 0.0f ? std::min(rgb[i], kGreatest) : 0.0f;
    most = std::max(most, clamped[i]);
  }
  int exponent = most > 0.0f ? std::ilogb(most) : -kBias - 1;
  exponent = std::max(-kBias - 1, exponent) + 1 + kBias;
  double scale = std::ldexp(1.0, kBias + kMantissaBits - exponent);
  if (std::lround(most * scale) == 1 << kMantissaBits) {
    ++exponent;
    scale *= 0.5;
  }
  exponent = std::min(exponent, kMostExponent);
  uint32_t packed = static_cast<uint32_t>(exponent) << 27;
  for (int i = 0; i < 3; ++i)
    packed |= static_cast<uint32_t>(std::lround(clamped[i] * scale)) << (kMantissaBits * i);
  return packed;
}

void unpackSharedExponent(uint32_t packed, float rgb[3]) {
  const int exponent = static_cast<int>(packed >> 27) - kBias - kMantissaBits;
  for (int i = 0; i < 3; ++i) {
    const auto mantissa = static_cast<float>(packed >> (kMantissaBits * i) & 511u);
    rgb[i] = std::ldexp(mantissa, exponent);
  }
}

}  // namespace alpenglow::cost
