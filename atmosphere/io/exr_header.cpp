#include "atmosphere/io/exr_header.h"

#include <cstring>
#include <optional>
#include <string_view>

namespace alpenglow::io {
namespace {

constexpr size_t kMaxNameLength = 255;
constexpr uint32_t kMultiPart = 0x1000;
constexpr uint32_t kMaxParts = 1024;

class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : bytes_(bytes) {}
  bool good() const { return good_; }
  bool atZero() const { return at_ < bytes_.size() && bytes_[at_] == '\0'; }

  /// Up to the next zero byte, which is skipped.
  std::string_view text() {
    if (!good_) return {};
    const size_t end = bytes_.substr(at_, kMaxNameLength + 1).find('\0');
    if (end == std::string_view::npos) {
      good_ = false;
      return {};
    }
    const size_t start = at_;
    at_ += end + 1;
    return bytes_.substr(start, end);
  }
  std::string_view take(size_t size) {
    if (!good_ || size > bytes_.size() - at_) {
      good_ = false;
      return {};
    }
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  int32_t integer() {
    const std::string_view four = take(4);
    int32_t value = 0;
    if (good_) std::memcpy(&value, four.data(), sizeof value);
    return value;
  }

 private:
  std::string_view bytes_;
  size_t at_ = 0;
  bool good_ = true;
};

// The library asserts, and ends the program, at a type of number that it doesn't know.
std::string checkChannels(std::string_view list, uint32_t maxChannels) {
  Cursor cursor(list);
  uint32_t count = 0;
  while (cursor.good() && !cursor.atZero()) {
    cursor.text();
    const int32_t type = cursor.integer();
    cursor.take(4);  // A flag and padding.
    const int32_t sampling[2] = {cursor.integer(), cursor.integer()};
    if (type < 0 || type > 2) return "has a channel of the unknown type " + std::to_string(type);
    if (sampling[0] != 1 || sampling[1] != 1) return "has a channel that is sampled sparsely";
    if (++count > maxChannels) return "has more than " + std::to_string(maxChannels) + " channels";
  }
  return cursor.good() ? "" : "has a broken list of channels";
}

// Texels of a data window; none when it is upside down.
std::optional<uint64_t> texelsOf(std::string_view window) {
  Cursor cursor(window);
  int64_t corner[4] = {};
  for (int64_t& value : corner) value = cursor.integer();
  const int64_t width = corner[2] - corner[0] + 1;
  const int64_t height = corner[3] - corner[1] + 1;
  if (!cursor.good() || width < 1 || height < 1) return std::nullopt;
  return static_cast<uint64_t>(width) * static_cast<uint64_t>(height);
}

std::string checkAttribute(std::string_view name, std::string_view value, uint64_t maxTexels,
                           uint32_t maxChannels) {
  if (name == "dataWindow") {
    const std::optional<uint64_t> texels = texelsOf(value);
    if (!texels) return "has an impossible data window";
    if (*texels > maxTexels) {
      return "has " + std::to_string(*texels) + " texels in a part; at most " +
             std::to_string(maxTexels) + " are read";
    }
  }
  if (name == "channels") return checkChannels(value, maxChannels);
  if (name == "tiles") return "has tiles, but lines were expected";
  if (name == "chunkCount") {
    const int32_t count = Cursor(value).integer();
    if (count < 0 || static_cast<uint64_t>(count) > maxTexels) return "has too many chunks";
  }
  return {};
}

}  // namespace

std::string checkExrHeaders(const std::string& bytes, uint64_t maxTexels, uint32_t maxChannels) {
  Cursor cursor(bytes);
  cursor.take(4);  // The magic number, which the caller knows.
  const uint32_t version = static_cast<uint32_t>(cursor.integer());
  const bool multiPart = (version & kMultiPart) != 0;
  uint32_t parts = 0;
  do {
    while (cursor.good() && !cursor.atZero()) {
      const std::string_view name = cursor.text();
      cursor.text();  // Its type.
      const int32_t size = cursor.integer();
      const std::string_view value =
          cursor.take(size < 0 ? bytes.size() : static_cast<size_t>(size));
      if (!cursor.good()) break;
      std::string problem = checkAttribute(name, value, maxTexels, maxChannels);
      if (!problem.empty()) return problem;
    }
    cursor.take(1);
    if (!cursor.good()) return "has a broken header";
    if (++parts > kMaxParts) return "has more than " + std::to_string(kMaxParts) + " parts";
  } while (multiPart && !cursor.atZero());  // An empty header ends the list.
  return {};
}

}  // namespace alpenglow::io
