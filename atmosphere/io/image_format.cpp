#include "atmosphere/io/image_format.h"

#include <algorithm>

#include "atmosphere/io/exr_header.h"
#include "atmosphere/io/png_chunks.h"

namespace alpenglow::io {

const char* imageFormatOf(const std::string& bytes) {
  const auto starts = [&](const char* magic, size_t size) {
    return bytes.compare(0, size, magic, size) == 0;
  };
  if (starts("\xFF\xD8\xFF", 3)) return "jpeg";
  if (starts("\x89PNG", 4)) return "png";
  if (starts("\x76\x2F\x31\x01", 4)) return "openexr";
  if (starts("II*\0", 4) || starts("MM\0*", 4)) return "tiff";
  return nullptr;
}

std::string imageDamage(const std::string& format, const std::string& bytes, uint64_t maxTexels) {
  if (format == "png") return checkPngChunks(bytes);
  if (format == "jpeg") {  // libjpeg fills what is missing with grey; its end marker tells.
    const size_t tail = std::min<size_t>(bytes.size(), 4096);
    const bool whole = bytes.find("\xFF\xD9", bytes.size() - tail) != std::string::npos;
    return whole ? "" : "is a truncated JPEG image";
  }
  if (format == "openexr") return checkExrHeaders(bytes, maxTexels, 64);
  return {};
}

}  // namespace alpenglow::io
