// Runs the built program and looks at what it did.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "../io/temporary_folder.h"

namespace alpenglow::test {

struct Outcome {
  int status = -1;  ///< Exit status; -1 when it was killed by a signal.
  std::string out;
  std::string err;
};

/// Runs the program with core and synchronisation validation, whatever it turns on itself; a
/// message of theirs fails the test. Environment variables are set for the program only, as
/// "NAME=value".
Outcome runProgram(const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment = {});

/// The environment in which the validation layer speaks on standard output. `advice` adds best
/// practices, of which there is always something to say.
std::vector<std::string> validated(bool advice);

/// Options that make bakes of the standard solver take a fraction of a second.
const std::vector<std::string>& smallTables();
/// The same of the moment solver.
const std::vector<std::string>& smallMoments();
/// Options that make them take hours: what is refused with these is refused before the bake.
const std::vector<std::string>& endlessTables();
std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b);

/// A folder and the program, for a test.
class Program : public testing::Test {
 protected:
  void expectGood(const std::vector<std::string>& arguments) {
    const Outcome outcome = runProgram(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
  }

  /// The program must fail with one sentence that has all of these words, print nothing else, and
  /// leave the folder as it was.
  void expectRefused(const std::vector<std::string>& arguments,
                     const std::vector<std::string>& words,
                     const std::vector<std::string>& environment = {});

  nlohmann::json jsonOf(const std::string& name) {
    return nlohmann::json::parse(contentsOf(folder_ / name), nullptr, false);
  }

  TemporaryFolder folder_;
};

}  // namespace alpenglow::test
