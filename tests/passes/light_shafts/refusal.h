// What the core library reported when it refused a call.
#pragma once

#include <alpenglow/types.h>
#include <gtest/gtest.h>

#include <string>

namespace alpenglow::testing {

/// Give `take` and this object's address to a call as its diagnostic callback.
struct Refusal {
  Status status = Status::Ok;
  std::string sentence;

  static void take(void* user, const Diagnostic& diagnostic) {
    auto* refusal = static_cast<Refusal*>(user);
    EXPECT_EQ(diagnostic.severity, Severity::Error);
    refusal->status = diagnostic.status;
    refusal->sentence = diagnostic.message;
  }
  /// One sentence that has each of these words.
  void expect(Status returned, Status expected, std::initializer_list<const char*> words) const {
    EXPECT_EQ(returned, expected);
    EXPECT_EQ(status, expected);
    ASSERT_FALSE(sentence.empty());
    EXPECT_EQ(sentence.back(), '.') << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    for (const char* word : words) EXPECT_NE(sentence.find(word), std::string::npos) << sentence;
  }
};

}  // namespace alpenglow::testing
