#include "failure.h"

#include <alpenglow/io/file.h>

namespace alpenglow::samples {

void check(const io::Done& done) {
  if (!done) throw Failure(done.error);
}

void writeText(const std::string& path, const std::string& text) {
  check(io::writeFile(path, text.data(), text.size()));
}

}  // namespace alpenglow::samples
