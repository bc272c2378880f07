// A look at a PNG file's chunks before libpng reads them: it prints to stderr about broken ones.
#pragma once

#include <string>

namespace alpenglow::io {

/// Empty when every chunk is whole, has its checksum, and the last is IEND; else what is wrong, as
/// the end of a sentence.
std::string checkPngChunks(const std::string& bytes);

}  // namespace alpenglow::io
