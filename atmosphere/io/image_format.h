// Checks of the first bytes of an image file, before the image library opens it.
#pragma once

#include <cstdint>
#include <string>

namespace alpenglow::io {

/// The image library's name of the format that the first bytes belong to: jpeg, png, openexr or
/// tiff; null for others.
const char* imageFormatOf(const std::string& bytes);

/// Checks before the image library allocates or prints messages of its own: empty, or the end of a
/// sentence about the error. `format` is imageFormatOf's. EXR files may have
/// `maxTexels` texels and 64 channels; the other formats' sizes are left to the caller.
std::string imageDamage(const std::string& format, const std::string& bytes, uint64_t maxTexels);

}  // namespace alpenglow::io
