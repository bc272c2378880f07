// RGB9E5: three 9-bit mantissas with one 5-bit exponent, as Vulkan's E5B9G9R9_UFLOAT_PACK32.
#pragma once

#include <cstdint>

namespace alpenglow::cost {

/// Rounded to the nearest, negative values and NaN to 0, large ones to the greatest, 65408.
uint32_t packSharedExponent(const float rgb[3]);
void unpackSharedExponent(uint32_t packed, float rgb[3]);

}  // namespace alpenglow::cost
