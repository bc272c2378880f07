#include "atmosphere/io/png_chunks.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace alpenglow::io {
namespace {

constexpr size_t kSignatureBytes = 8;

// CRC-32 of ISO 3309, as PNG prescribes.
uint32_t crcOf(std::string_view bytes) {
  static const std::array<uint32_t, 256> kTable = [] {
    std::array<uint32_t, 256> table = {};
    for (uint32_t i = 0; i < 256; ++i) {
      uint32_t c = i;
      for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
      table[i] = c;
    }
    return table;
  }();
  uint32_t crc = 0xFFFFFFFFu;
  for (const char byte : bytes)
    crc = kTable[(crc ^ static_cast<uint8_t>(byte)) & 0xFF] ^ (crc >> 8);
  return ~crc;
}

uint32_t bigEndian(std::string_view bytes) {
  uint32_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<uint8_t>(bytes[i]);
  return value;
}

}  // namespace

std::string checkPngChunks(const std::string& bytes) {
  const std::string_view all = bytes;
  size_t at = kSignatureBytes;
  while (at < all.size() && all.size() - at >= 12) {
    const size_t length = bigEndian(all.substr(at));
    if (length > all.size() - at - 12) break;
    const std::string_view body = all.substr(at + 4, length + 4);
    if (crcOf(body) != bigEndian(all.substr(at + 8 + length))) {
      return "is a damaged PNG image: a checksum is wrong";
    }
    at += length + 12;
    if (body.substr(0, 4) == "IEND") return {};
  }
  return "is a truncated PNG image";
}

}  // namespace alpenglow::io
