#include "viewer.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>

namespace alpenglow::test {

Display::Display() {
  int pipe[2] = {-1, -1};
  EXPECT_EQ(::pipe(pipe), 0);
  process_ = ::fork();
  if (process_ == 0) {
    ::close(pipe[0]);
    ::freopen("/dev/null", "w", stderr);
    const std::string descriptor = std::to_string(pipe[1]);
    ::execlp("Xvfb", "Xvfb", "-displayfd", descriptor.c_str(), "-screen", "0", "1280x1024x24",
             "-nolisten", "tcp", static_cast<char*>(nullptr));
    ::_exit(127);
  }
  ::close(pipe[1]);
  std::string digits;
  for (char c = 0; ::read(pipe[0], &c, 1) == 1 && c != '\n';) digits += c;
  ::close(pipe[0]);
  EXPECT_FALSE(digits.empty()) << "Xvfb doesn't start; scripts/packages.sh installs it.";
  name_ = ":" + digits;
}

Display::~Display() {
  ::kill(process_, SIGTERM);
  ::waitpid(process_, nullptr, 0);
}

Viewer::Viewer() {
  scene_ = folder_.write("scene.json", R"({
    "atmosphere": "earth", "quality": "draft",
    "sun": { "elevation_deg": 20, "azimuth_deg": 100 },
    "camera": { "altitude_m": 500, "heading_deg": 90, "pitch_deg": 5, "latitude_deg": 20 } })");
}

Outcome Viewer::run(const std::vector<std::string>& arguments) {
  return runProgram(arguments, {"DISPLAY=" + display_.name(), "XDG_CONFIG_HOME=" + folder_.path()});
}

void Viewer::play(const std::string& script, const std::vector<std::string>& options) {
  std::string text = script;
  // "@name" is a file in the folder.
  for (size_t i = text.find('@'); i != std::string::npos; i = text.find('@')) {
    text.replace(i, 1, folder_.path() + "/");
  }
  std::vector<std::string> arguments = {"--script", folder_.write("script.txt", text + "\nquit\n")};
  const auto given = [&](const std::string& name) {
    return std::find(options.begin(), options.end(), name) != options.end();
  };
  if (!given("--config")) {
    arguments.push_back("--config");
    arguments.push_back(folder_.write("fast.json", R"({"window": {"vsync": false}})"));
  }
  if (!given("--size")) arguments.insert(arguments.end(), {"--size", "160x96"});
  if (!given("--flythrough") && !given(scene_)) arguments.push_back(scene_);
  const Outcome outcome = run(joined(arguments, options));
  EXPECT_EQ(outcome.status, 0) << script;
  EXPECT_EQ(outcome.err, "") << script;
}

void Viewer::expectRefused(const std::vector<std::string>& arguments,
                           const std::vector<std::string>& words) {
  const Outcome outcome = run(arguments);
  EXPECT_GT(outcome.status, 0);
  EXPECT_LE(outcome.status, 2);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const std::string& word : words) {
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  }
}

}  // namespace alpenglow::test
