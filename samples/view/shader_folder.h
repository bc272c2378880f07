// Shaders that are edited while the program runs: a folder like shaders/glsl, watched, its files
// compiled in the background, and handed to the library in place of its own.
#pragma once

#include <alpenglow/context.h>

#include <chrono>
#include <filesystem>
#include <future>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace alpenglow::view {

class ShaderFolder {
 public:
  /// Throws a Failure when it has no shaders.
  explicit ShaderFolder(const std::string& folder);

  /// For ContextDesc::shaders; outlives the context.
  ShaderHook hook();

  /// Looks for changes from time to time. True once when what has changed was compiled: pipelines
  /// are to be rebuilt. Until then, and when it doesn't compile, the code stays as it was.
  bool poll();
  /// Takes the last change back: the library has refused it.
  void undo() { code_ = before_; }
  /// What the compiler says of what has changed; empty: it compiles.
  const std::string& error() const { return error_; }
  bool compiling() const { return compiled_.valid(); }

 private:
  struct Shader {
    std::string source;
    std::vector<std::string> defines;
  };
  using Code = std::map<std::string, std::vector<uint32_t>>;  ///< By name.
  struct Compiled {
    Code code;
    std::string error;
  };
  using Times = std::map<std::string, std::filesystem::file_time_type>;
  Times times() const;
  std::set<std::string> filesOf(const std::string& source) const;
  std::set<std::string> changedShaders();
  static Compiled compile(const std::string& folder, const std::map<std::string, Shader>& shaders);

  std::string folder_;
  std::map<std::string, Shader> shaders_;  ///< All there are, by name.
  std::set<std::string> used_;             ///< Names that the library has asked for.
  std::set<std::string> pending_;          ///< Those that have changed and aren't compiled yet.
  size_t tried_ = 0;                       ///< How many of them were compiled last.
  Code code_, before_;
  Times times_;
  std::future<Compiled> compiled_;
  std::string error_;
  std::chrono::steady_clock::time_point lastLook_ = {};
};

}  // namespace alpenglow::view
