// What the first bytes of an image file tell, before the image library sees it.
#pragma once

#include <cstdint>
#include <string>

namespace alpenglow::io {

/// The image library's name of the format that the first bytes belong to: jpeg, png, openexr or
/// tiff; null for others.
const char* imageFormatOf(const std::string& bytes);

/// What can be checked before the image library allocates, or prints complaints of its own: empty,
/// or what is wrong as the end of a sentence. `format` is imageFormatOf's. EXR files may have
/// `maxTexels` texels and 64 channels; the other formats' sizes are left to the caller.
std::string imageDamage(const std::string& format, const std::string& bytes, uint64_t maxTexels);

}  // namespace alpenglow::io
