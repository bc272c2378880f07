#include "frame_list.h"

#include <alpenglow/io/flythrough_file.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "failure.h"

namespace alpenglow::cli {
namespace {

struct FrameRange {
  uint32_t first = 0;
  uint32_t last = 0;
};

std::optional<uint32_t> frameOf(const std::string& text) {
  const bool digits = !text.empty() && text.size() <= 9 &&
                      text.find_first_not_of("0123456789") == std::string::npos;
  if (!digits) return std::nullopt;
  const auto frame = static_cast<uint32_t>(std::stoul(text));
  return frame < io::kMaxFlythroughFrames ? std::optional(frame) : std::nullopt;
}

std::optional<FrameRange> rangeOf(const std::string& text) {
  const size_t dash = text.find('-');
  const auto first = frameOf(text.substr(0, dash));
  const auto last = dash == std::string::npos ? first : frameOf(text.substr(dash + 1));
  if (!first || !last || *last < *first) return std::nullopt;
  return FrameRange{*first, *last};
}

// None: not a list of frames.
std::optional<std::vector<FrameRange>> rangesOf(const std::string& text) {
  std::vector<FrameRange> ranges;
  std::istringstream stream(text + ",");
  for (std::string part; std::getline(stream, part, ',');) {
    const std::optional<FrameRange> range = rangeOf(part);
    if (!range) return std::nullopt;
    ranges.push_back(*range);
  }
  return ranges;
}

}  // namespace

std::string checkFrames(const std::string& text) {
  if (rangesOf(text)) return {};
  return "'" + text + "' is not a list of frames and ranges of frames, such as 0,24,48-96";
}

std::vector<uint32_t> parseFrames(const std::string& text, uint32_t count) {
  std::vector<uint32_t> frames;
  for (const FrameRange& range : rangesOf(text).value_or(std::vector<FrameRange>())) {
    if (range.last >= count) {
      throw Failure("--frames " + text + " names frame " + std::to_string(range.last) +
                        ", but the flythrough's last is " + std::to_string(count - 1) + ".",
                    Failure::kUsage);
    }
    for (uint32_t frame = range.first; frame <= range.last; ++frame) frames.push_back(frame);
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

}  // namespace alpenglow::cli
