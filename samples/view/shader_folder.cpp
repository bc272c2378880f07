#include "shader_folder.h"

#include <alpenglow/io/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "common/failure.h"

namespace alpenglow::view {
namespace {

namespace fs = std::filesystem;
using samples::Failure;

constexpr uint64_t kMostBytes = 64 << 20;
constexpr auto kLookEvery = std::chrono::milliseconds(300);

// An argument of a shell command.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

// What a command prints; `status` is 0 when it succeeded.
std::string outputOf(const std::string& command, int* status) {
  std::string text;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) {
    *status = -1;
    return "The command " + command + " can't be run.";
  }
  char part[4096];
  while (const size_t size = std::fread(part, 1, sizeof part, pipe)) text.append(part, size);
  *status = ::pclose(pipe);
  return text;
}

}  // namespace

ShaderFolder::ShaderFolder(const std::string& folder) : folder_(folder) {
  std::error_code code;
  std::string list = folder + "/shaders.json";
  if (!fs::exists(list, code)) list = ALPENGLOW_SHADER_LIST;
  const std::string text = samples::take(io::readFile(list, kMostBytes));
  try {
    for (const auto& shader : nlohmann::json::parse(text)) {
      shaders_[shader.at("name")] = {shader.at("source"),
                                     shader.at("defines").get<std::vector<std::string>>()};
    }
  } catch (const nlohmann::json::exception& reason) {
    throw Failure("The list of shaders '" + list +
                  "' is none as a build writes it: " + reason.what() + ".");
  }
  const std::string first = shaders_.empty() ? "" : shaders_.begin()->second.source;
  if (!fs::exists(fs::path(folder) / first, code)) {
    throw Failure("The folder '" + folder + "' has no file " + first +
                  ", but --shaders needs one like shaders/glsl.");
  }
  times_ = times();
}

ShaderHook ShaderFolder::hook() {
  ShaderHook hook;
  hook.user = this;
  hook.replace = [](void* user, const char* name, const uint32_t** code, size_t* bytes) {
    auto* self = static_cast<ShaderFolder*>(user);
    self->used_.insert(name);
    const auto found = self->code_.find(name);
    if (found == self->code_.end()) return false;
    *code = found->second.data();
    *bytes = found->second.size() * sizeof(uint32_t);
    return true;
  };
  return hook;
}

ShaderFolder::Times ShaderFolder::times() const {
  Times times;
  std::error_code code;
  // Files may come and go meanwhile.
  for (fs::recursive_directory_iterator i(folder_, code), end; !code && i != end;
       i.increment(code)) {
    std::error_code gone;
    if (!i->is_regular_file(gone)) continue;
    times[i->path().lexically_relative(folder_).string()] = i->last_write_time(gone);
  }
  return times;
}

// A file and all that it includes, which are beside it or named from the folder.
std::set<std::string> ShaderFolder::filesOf(const std::string& source) const {
  const std::string include = "#include \"";
  std::set<std::string> all;
  std::vector<std::string> open = {source};
  while (!open.empty()) {
    const std::string file = open.back();
    open.pop_back();
    const auto text = io::readFile(folder_ + "/" + file, kMostBytes);
    if (!text || !all.insert(file).second) continue;
    for (size_t at = text->find(include); at != std::string::npos; at = text->find(include, at)) {
      at += include.size();
      const std::string name = text->substr(at, text->find('"', at) - at);
      open.push_back(name);
      open.push_back((fs::path(file).parent_path() / name).lexically_normal().string());
    }
  }
  return all;
}

ShaderFolder::Compiled ShaderFolder::compile(const std::string& folder,
                                             const std::map<std::string, Shader>& shaders) {
  Compiled result;
  char output[] = "/tmp/alpenglow-shader-XXXXXX";
  const int file = ::mkstemp(output);
  if (file < 0) {
    result.error = "There is no place for compiled shaders in /tmp.";
    return result;
  }
  ::close(file);
  for (const auto& [name, shader] : shaders) {
    std::string command = "glslangValidator --quiet -V --target-env vulkan1.2 -g0";
    for (const std::string& define : shader.defines) command += " " + quoted("-D" + define);
    command +=
        " " + quoted("-I" + folder) + " -o " + output + " " + quoted(folder + "/" + shader.source);
    int status = 0;
    const std::string said = outputOf(command, &status);
    if (status != 0) {
      result.error = said.empty() ? "The command failed: " + command : said;
      break;
    }
    const auto bytes = io::readFile(output, kMostBytes);
    if (!bytes) {
      result.error = bytes.error;
      break;
    }
    std::vector<uint32_t>& words = result.code[name];
    words.resize(bytes->size() / sizeof(uint32_t));
    std::memcpy(words.data(), bytes->data(), words.size() * sizeof(uint32_t));
  }
  ::unlink(output);
  return result;
}

// Names whose files have changed since the last look.
std::set<std::string> ShaderFolder::changedShaders() {
  const Times before = std::exchange(times_, times());
  std::set<std::string> files, names;
  for (const auto& [file, time] : times_) {
    const auto found = before.find(file);
    if (found == before.end() || found->second != time) files.insert(file);
  }
  if (files.empty()) return names;
  std::map<std::string, bool> stale;  // By source, which many share.
  for (const auto& [name, shader] : shaders_) {
    const auto [known, isNew] = stale.emplace(shader.source, false);
    if (isNew) {
      const std::set<std::string> of = filesOf(shader.source);
      known->second = std::any_of(of.begin(), of.end(),
                                  [&](const std::string& file) { return files.contains(file); });
    }
    if (known->second) names.insert(name);
  }
  return names;
}

bool ShaderFolder::poll() {
  if (compiled_.valid()) {
    if (compiled_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    Compiled compiled = compiled_.get();
    error_ = std::move(compiled.error);
    if (!error_.empty()) return false;
    before_ = code_;
    tried_ = 0;
    for (auto& [name, words] : compiled.code) {
      pending_.erase(name);
      code_[name] = std::move(words);
    }
    return true;
  }
  const auto now = std::chrono::steady_clock::now();
  if (now - lastLook_ < kLookEvery) return false;
  lastLook_ = now;
  const std::set<std::string> changed = changedShaders();
  pending_.insert(changed.begin(), changed.end());
  // All of it that is in use, so that what doesn't compile is not forgotten; again only if
  // something is other than when it didn't.
  std::map<std::string, Shader> wanted;
  for (const std::string& name : pending_) {
    if (used_.contains(name)) wanted[name] = shaders_.at(name);
  }
  if (wanted.empty() || (changed.empty() && wanted.size() == tried_)) return false;
  tried_ = wanted.size();
  compiled_ = std::async(std::launch::async, compile, folder_, std::move(wanted));
  return false;
}

}  // namespace alpenglow::view
