#include "program.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

namespace alpenglow::test {
namespace {

[[noreturn]] void becomeProgram(const std::vector<std::string>& arguments,
                                const std::vector<std::string>& environment, const std::string& out,
                                const std::string& err) {
  const int flags = O_WRONLY | O_CREAT | O_TRUNC;
  ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
  ::dup2(::open(out.c_str(), flags, 0600), STDOUT_FILENO);
  ::dup2(::open(err.c_str(), flags, 0600), STDERR_FILENO);
  std::vector<std::string> variables = environment;
  for (std::string& variable : variables) ::putenv(variable.data());
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), ALPENGLOW_PROGRAM);
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(ALPENGLOW_PROGRAM, pointers.data());
  ::_exit(127);
}

std::string shown(const std::vector<std::string>& arguments) {
  std::string text = "alpenglow";
  for (const std::string& argument : arguments) text += ' ' + argument;
  return text;
}

}  // namespace

std::vector<std::string> validated(bool advice) {
  static const TemporaryFolder folders[2];
  const TemporaryFolder& folder = folders[advice ? 1 : 0];
  folder.write("vk_layer_settings.txt",
               "khronos_validation.debug_action = VK_DBG_LAYER_ACTION_LOG_MSG\n"
               "khronos_validation.log_filename = stdout\n"
               "khronos_validation.report_flags = error,warn" +
                   std::string(advice ? ",perf" : "") +
                   "\nkhronos_validation.enables = "
                   "VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT" +
                   (advice ? ",VK_VALIDATION_FEATURE_ENABLE_BEST_PRACTICES_EXT" : "") + "\n");
  return {"VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation",
          "VK_LAYER_SETTINGS_PATH=" + folder.path()};
}

Outcome runProgram(const std::vector<std::string>& arguments,
                   const std::vector<std::string>& environment) {
  const std::vector<std::string> variables = joined(validated(false), environment);
  const TemporaryFolder folder;
  const pid_t child = ::fork();
  if (child == 0) becomeProgram(arguments, variables, folder / "out", folder / "err");
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status)) << shown(arguments);
  const std::string out = contentsOf(folder / "out");
  // Where a test asks for advice, it looks at the messages itself.
  const bool asked = environment == validated(true);
  EXPECT_TRUE(asked || out.find("Validation") == std::string::npos) << shown(arguments) << out;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, out, contentsOf(folder / "err")};
}

const std::vector<std::string>& smallTables() {
  static const std::vector<std::string> kOptions = {"--solver",
                                                    "standard",
                                                    "--orders",
                                                    "2",
                                                    "--size-scattering",
                                                    "4x8x8x2",
                                                    "--size-irradiance",
                                                    "16x4",
                                                    "--size-transmittance",
                                                    "64x16"};
  return kOptions;
}

const std::vector<std::string>& smallMoments() {
  static const std::vector<std::string> kOptions = {
      "--quality", "draft", "--moments",
      "depthMu=32,depthH=16,nodesR=6,nodesMuS=12,degree=4,azimuths=4,sourceGamma=12,sourcePsi=4"};
  return kOptions;
}

const std::vector<std::string>& endlessTables() {
  static const std::vector<std::string> kOptions = {"--solver", "standard", "--orders", "1000"};
  return kOptions;
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

void Program::expectRefused(const std::vector<std::string>& arguments,
                            const std::vector<std::string>& words,
                            const std::vector<std::string>& environment) {
  std::vector<std::string> before = folder_.names();
  const Outcome outcome = runProgram(arguments, environment);
  std::vector<std::string> after = folder_.names();
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  EXPECT_EQ(before, after) << shown(arguments);
  EXPECT_GT(outcome.status, 0) << shown(arguments);
  EXPECT_LE(outcome.status, 2) << shown(arguments);
  EXPECT_EQ(outcome.out, "") << shown(arguments);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  if (!outcome.err.empty()) {
    expectSentence(outcome.err.substr(0, outcome.err.size() - 1));
  }
  for (const std::string& word : words) {
    EXPECT_NE(outcome.err.find(word), std::string::npos)
        << shown(arguments) << " said: " << outcome.err;
  }
}

}  // namespace alpenglow::test
