// A look at the headers of an EXR file before the image library opens it: the library allocates by
// what they say, gigabytes if need be.
#pragma once

#include <cstdint>
#include <string>

namespace alpenglow::io {

/// Empty when the headers are whole, every attribute lies in the file, and no part has more than
/// `maxTexels` texels or more than `maxChannels` channels; else what is wrong, as the end of a
/// sentence.
std::string checkExrHeaders(const std::string& bytes, uint64_t maxTexels, uint32_t maxChannels);

}  // namespace alpenglow::io
