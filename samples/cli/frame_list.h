// Which frames of a flythrough are wanted, as --frames names them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace alpenglow::cli {

/// Parses "0,24,48-96" and the like: the frames, each once, in order. Throws a usage Failure for
/// anything else, and for a frame that isn't below `count`.
std::vector<uint32_t> parseFrames(const std::string& text, uint32_t count);

/// An option's check: empty when the string names frames, else what is wrong with it.
std::string checkFrames(const std::string& text);

}  // namespace alpenglow::cli
