// From linear radiance to 8-bit sRGB: automatic exposure, tone maps and dither.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace alpenglow::io {

enum class ToneMap : uint32_t { Filmic, Reinhard, Linear };
/// Their names in files, in the order of the enumeration.
const std::vector<std::string>& toneMapNames();

/// Rows from the top, three values a pixel: R, G, B.
template <typename T>
struct RgbImage {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<T> pixels;
};
using LinearImage = RgbImage<float>;
using ByteImage = RgbImage<uint8_t>;

/// The factor that brings a picture's typical brightness to middle grey. Luminances (Rec. 709
/// weights) of pixels that are not black, sorted: the 99th percentile is called white, so that a
/// sun disc of less than 1 % of the lit pixels doesn't count. The geometric mean over the pixels
/// between white / 64 and white, so that black space, a fisheye's border and a night side don't
/// count either, goes to 0.2; but white goes to 4 at most. Clamped to [1e-9, 1e12]; 1 for a picture
/// that is black.
double automaticExposure(const LinearImage& image);

/// Exposes, maps, applies the sRGB curve and rounds to 8 bits with a dither of one step that
/// depends only on the pixel's place, so that smooth skies show no bands; 0 stays 0.
ByteImage toneMapped(const LinearImage& image, double exposure, ToneMap toneMap);

}  // namespace alpenglow::io
