#include "engine/text.h"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace alpenglow::engine {
namespace {

/// Bounded text that is always terminated.
class Writer {
 public:
  Writer(char* out, size_t size) : next_(out), end_(out + size - 1) { *out = '\0'; }
  void put(char c) {
    if (next_ == end_) return;
    *next_++ = c;
    *next_ = '\0';
  }
  void put(const char* text) {
    for (; *text != '\0'; ++text) put(*text);
  }
  template <typename Number, typename... How>
  void number(Number value, How... how) {
    char digits[40];
    const std::to_chars_result end =
        std::to_chars(digits, digits + sizeof digits - 1, value, how...);
    *end.ptr = '\0';
    put(digits);
  }

 private:
  char* next_;
  char* end_;
};

/// What follows a '%': how long an integer is, and its conversion.
struct Conversion {
  int longs = 0;
  bool size = false;
  char letter = '\0';
};

Conversion read(const char** format) {
  Conversion conversion;
  for (; **format == 'l'; ++*format) ++conversion.longs;
  if (**format == 'z') {
    conversion.size = true;
    ++*format;
  }
  conversion.letter = **format;
  if (conversion.letter != '\0') ++*format;
  return conversion;
}

}  // namespace

void formatText(char* out, size_t size, const char* format, std::va_list arguments) noexcept {
  if (size == 0) return;
  Writer writer(out, size);
  const auto integer = [&](const Conversion& c) -> uint64_t {
    if (c.size) return va_arg(arguments, size_t);
    if (c.longs > 1) return va_arg(arguments, unsigned long long);
    return c.longs == 1 ? va_arg(arguments, unsigned long) : va_arg(arguments, unsigned);
  };
  while (*format != '\0') {
    if (*format != '%') {
      writer.put(*format++);
      continue;
    }
    ++format;
    const Conversion c = read(&format);
    switch (c.letter) {
      case 's': {
        const char* const text = va_arg(arguments, const char*);
        writer.put(text != nullptr ? text : "(null)");
        break;
      }
      case 'd':
        writer.number(c.longs > 1    ? int64_t{va_arg(arguments, long long)}
                      : c.longs == 1 ? int64_t{va_arg(arguments, long)}
                                     : int64_t{va_arg(arguments, int)});
        break;
      case 'u':
        writer.number(integer(c));
        break;
      case 'x':
        writer.number(integer(c), 16);
        break;
      case 'g':
        writer.number(va_arg(arguments, double), std::chars_format::general, 6);
        break;
      default:
        writer.put(c.letter != '\0' ? c.letter : '%');
    }
  }
}

}  // namespace alpenglow::engine
