#include <alpenglow/io/tone_map.h>

#include <algorithm>
#include <cmath>

#include "atmosphere/io/tone_curve.h"

namespace alpenglow::io {
namespace {

constexpr double kMiddleGrey = 0.2;
constexpr double kBrightestWhite = 4.0;
constexpr double kWhitePercentile = 0.99;
constexpr double kCountedRange = 64.0;

std::vector<float> litLuminances(const LinearImage& image) {
  std::vector<float> luminances;
  luminances.reserve(image.pixels.size() / 3);
  for (size_t i = 0; i + 2 < image.pixels.size(); i += 3) {
    const float* c = &image.pixels[i];
    const float luminance = 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
    if (std::isfinite(luminance) && luminance > 0.0f) luminances.push_back(luminance);
  }
  return luminances;
}

// A number in [0, 1) that depends on the pixel's place alone, without a visible pattern.
float ditherAt(uint32_t x, uint32_t y, uint32_t channel) {
  uint32_t h = x * 0x9E3779B1u ^ y * 0x85EBCA77u ^ channel * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  h ^= h >> 15;
  return static_cast<float>(h >> 8) * 0x1p-24f;
}

float mapTone(float value, ToneMap toneMap) {
  switch (toneMap) {
    case ToneMap::Filmic:
      return tone::alpenglowToneFilmic(value);
    case ToneMap::Reinhard:
      return tone::alpenglowToneReinhard(value);
    case ToneMap::Linear:
      break;
  }
  return tone::alpenglowToneLinear(value);
}

// Black and white are not dithered. NaN becomes black.
uint8_t encoded(float value, float dither) {
  if (value >= 1.0f) return 255;
  if (!(value > 0.0f)) return 0;
  return static_cast<uint8_t>(std::floor(255.0f * tone::alpenglowSrgbEncode(value) + dither));
}

}  // namespace

const std::vector<std::string>& toneMapNames() {
  static const std::vector<std::string> kNames = {"filmic", "reinhard", "linear"};
  return kNames;
}

double automaticExposure(const LinearImage& image) {
  std::vector<float> lit = litLuminances(image);
  if (lit.empty()) return 1.0;
  const auto whiteAt =
      static_cast<std::ptrdiff_t>(static_cast<double>(lit.size() - 1) * kWhitePercentile);
  std::nth_element(lit.begin(), lit.begin() + whiteAt, lit.end());
  const double white = static_cast<double>(lit[static_cast<size_t>(whiteAt)]);
  double sum = 0.0;
  double count = 0.0;
  for (const float luminance : lit) {
    const double value = static_cast<double>(luminance);
    if (value < white / kCountedRange || value > white) continue;
    sum += std::log2(value);
    count += 1.0;
  }
  const double mean = std::exp2(sum / count);
  return std::clamp(std::min(kMiddleGrey / mean, kBrightestWhite / white), 1e-9, 1e12);
}

ByteImage toneMapped(const LinearImage& image, double exposure, ToneMap toneMap) {
  ByteImage out{image.width, image.height, std::vector<uint8_t>(image.pixels.size())};
  const float factor = static_cast<float>(exposure);
  for (uint32_t y = 0; y < image.height; ++y) {
    for (uint32_t x = 0; x < image.width; ++x) {
      const size_t first = (size_t{y} * image.width + x) * 3;
      for (uint32_t c = 0; c < 3; ++c) {
        const float mapped = mapTone(image.pixels[first + c] * factor, toneMap);
        out.pixels[first + c] = encoded(mapped, ditherAt(x, y, c));
      }
    }
  }
  return out;
}

}  // namespace alpenglow::io
