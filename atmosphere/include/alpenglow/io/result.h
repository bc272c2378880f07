// How the helper library Alpenglow::io reports: no exception leaves it.
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace alpenglow::io {

/// A value, or one full sentence that says why there is none.
template <typename T>
struct Result {
  std::optional<T> value;
  std::string error;

  Result(T v) : value(std::move(v)) {}  // NOLINT: returning a plain value is the common case
  static Result failure(std::string sentence) {
    Result result;
    result.error = std::move(sentence);
    return result;
  }
  explicit operator bool() const { return value.has_value(); }
  T& operator*() { return *value; }
  const T& operator*() const { return *value; }
  T* operator->() { return &*value; }
  const T* operator->() const { return &*value; }

 private:
  Result() = default;
};

/// Of functions that only succeed or fail: empty, or the sentence.
struct [[nodiscard]] Done {
  std::string error;
  explicit operator bool() const { return error.empty(); }
};

}  // namespace alpenglow::io
