// Sentences as printf writes them, whatever the host's locale: "1.5", never "1,5".
#pragma once

#include <cstdarg>
#include <cstddef>

namespace alpenglow::engine {

/// Writes at most `size` bytes with the final NUL; the rest is cut off. Knows %s, %d, %u, %x, %g,
/// %% and the lengths l, ll and z, without flags, width or precision.
void formatText(char* out, size_t size, const char* format, std::va_list arguments) noexcept;

}  // namespace alpenglow::engine
