// The image library in use: its errors as sentences, and files in memory.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <memory>
#include <string>

namespace alpenglow::io {

/// Text from a library or a file as part of a sentence: on one line, plain ASCII, without the full
/// stop.
inline std::string oneLine(std::string text) {
  for (char& c : text) {
    if (c < ' ' || c > '~') c = c == '\n' || c == '\r' || c == '\t' ? ' ' : '?';
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  if (text.size() > 300) text = text.substr(0, 297) + "...";
  return text.empty() ? "unknown reason" : text;
}

/// An image that is read from bytes in memory, which must outlive it. Members are destroyed in
/// reverse, so the reader goes before the proxy that it reads through. `config` holds the library's
/// hints, such as "oiio:UnassociatedAlpha".
struct MemoryInput {
  OIIO::Filesystem::IOMemReader proxy;
  std::unique_ptr<OIIO::ImageInput> input;
  std::string error;

  MemoryInput(const std::string& bytes, const char* format, const OIIO::ImageSpec& config = {})
      : proxy(const_cast<char*>(bytes.data()), bytes.size()),
        input(OIIO::ImageInput::create(format)) {
    if (!input || !input->set_ioproxy(&proxy)) {
      input.reset();
      error = "OpenImageIO has no reader for the format " + std::string(format);
      return;
    }
    OIIO::ImageSpec spec;
    if (!input->open("memory." + std::string(format), spec, config)) {
      error = oneLine(input->geterror());
      input.reset();
    }
  }
};

}  // namespace alpenglow::io
