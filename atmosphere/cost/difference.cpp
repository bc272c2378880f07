#include "atmosphere/cost/difference.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace alpenglow::cost {
namespace {

float luminanceOf(const io::LinearImage& image, size_t i) {
  return image.pixels[i] * 0.2126f + image.pixels[i + 1] * 0.7152f + image.pixels[i + 2] * 0.0722f;
}

/// A ten thousandth of a bright pixel's luminance, though not of the sun's disc, which is so bright
/// that nothing beside it would differ.
float floorOf(const io::LinearImage& finest) {
  std::vector<float> sorted;
  for (size_t i = 0; i < finest.pixels.size(); i += 3) sorted.push_back(luminanceOf(finest, i));
  const auto bright = sorted.begin() + static_cast<ptrdiff_t>(sorted.size() * 99 / 100);
  std::nth_element(sorted.begin(), bright, sorted.end());
  return std::max(1e-4f * *bright, 1e-20f);
}

}  // namespace

io::ByteImage differenceOf(const io::LinearImage& image, const io::LinearImage& finest) {
  io::ByteImage result{image.width, image.height, std::vector<uint8_t>(image.pixels.size())};
  const float floor = floorOf(finest);
  for (size_t i = 0; i < image.pixels.size(); i += 3) {
    const float a = luminanceOf(image, i) + floor, b = luminanceOf(finest, i) + floor;
    const float off = std::clamp(std::log2(a / b), -1.0f, 1.0f);
    const auto byte = [](float share) { return static_cast<uint8_t>(255.0f * share + 0.5f); };
    result.pixels[i] = byte(off < 0.0f ? 1.0f + 0.87f * off : 1.0f - 0.16f * off);
    result.pixels[i + 1] = byte(1.0f - 0.75f * std::abs(off));
    result.pixels[i + 2] = byte(off > 0.0f ? 1.0f - 0.87f * off : 1.0f + 0.16f * off);
  }
  return result;
}

}  // namespace alpenglow::cost
