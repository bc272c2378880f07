// Height maps: images whose first channel is the height of the ground.
#pragma once

#include <alpenglow/io/result.h>

#include <cstdint>
#include <string>
#include <vector>

namespace alpenglow::io {

/// Most samples along a side of a height map, and in all; checked before they are read.
inline constexpr uint32_t kMaxHeightSide = 8192;
inline constexpr uint32_t kMaxHeightSamples = 1u << 24;

/// What the image's numbers mean: height in metres = value * metersPerUnit + offset_m.
struct HeightUnits {
  double metersPerUnit = 1.0;  ///< Above 0. The unit of integer formats is 1, never the full scale.
  double offset_m = 0.0;
};

/// Heights in metres, row by row from the image's upper left corner.
struct HeightMap {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<float> heights_m;
};

/// Reads a PNG (8 or 16 bits, no palette), TIFF (integers of 8, 16 or 32 bits, or floats) or EXR
/// image of at least 2x2 samples. Channels other than the first are ignored: the height is the grey
/// of a grey image, the red of a colour image. Alpha changes nothing. The error names what is
/// wrong, and where a height is not finite.
Result<HeightMap> readHeightMap(const std::string& path, const HeightUnits& units = {});

}  // namespace alpenglow::io
