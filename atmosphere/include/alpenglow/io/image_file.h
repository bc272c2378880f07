// Pictures: EXR and PNG out, albedo maps in.
#pragma once

#include <alpenglow/io/result.h>
#include <alpenglow/io/tone_map.h>

#include <cstdint>
#include <string>
#include <vector>

namespace alpenglow::io {

/// 32-bit float R, G, B, no colour conversion. Written whole or not at all.
Done writeExr(const std::string& path, const LinearImage& image);
/// 8-bit sRGB, no alpha. Written whole or not at all.
Done writePng(const std::string& path, const ByteImage& image);
/// Reads the first three channels of a picture as 32-bit floats, as they are stored.
Result<LinearImage> readExr(const std::string& path);

/// Most texels of an albedo map; its size is checked before its texels are read.
inline constexpr uint32_t kMaxAlbedoWidth = 16384;
inline constexpr uint32_t kMaxAlbedoHeight = 8192;

/// An albedo map for an sRGB texture, with its chain of mip levels down to 1x1.
struct AlbedoMap {
  struct Level {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;  ///< sRGB-encoded, alpha 255.
  };
  std::vector<Level> levels;
};

/// Reads a JPEG, PNG, TIFF or EXR image. EXR and other float images hold linear values, which are
/// clamped to [0, 1] and sRGB-encoded; all others hold sRGB. Grey is spread over the channels, and
/// alpha is dropped.
Result<AlbedoMap> readAlbedoMap(const std::string& path);

/// Halves the last level, in linear light, until it is 1x1. For maps made in memory.
void addMipLevels(AlbedoMap* map);

}  // namespace alpenglow::io
