#include "sample_files.h"

#include <cstdlib>
#include <filesystem>
#include <set>
#include <vector>

#include "failure.h"

namespace alpenglow::samples {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> dataFolders() {
  std::vector<fs::path> folders;
  if (const char* given = std::getenv("ALPENGLOW_DATA_DIR"); given != nullptr && *given != '\0') {
    folders.emplace_back(given);
  }
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  if (!code) folders.push_back(program.parent_path() / ALPENGLOW_INSTALLED_DATA_DIR);
  folders.emplace_back(ALPENGLOW_SAMPLES_DIR);
  return folders;
}

// ", such as a, b", of all samples of a kind.
std::string namesOf(const std::string& kind) {
  std::set<std::string> names;
  std::error_code code;
  for (const fs::path& folder : dataFolders()) {
    for (const auto& entry : fs::directory_iterator(folder / kind, code)) {
      if (entry.path().extension() == ".json") names.insert(entry.path().stem().string());
    }
  }
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "; samples are " : ", ") + name;
  return text;
}

}  // namespace

std::string findSample(const std::string& kind, const std::string& nameOrPath) {
  std::error_code code;
  if (!nameOrPath.empty() && nameOrPath.find('/') == std::string::npos) {
    for (const fs::path& folder : dataFolders()) {
      const fs::path path = folder / kind / (nameOrPath + ".json");
      if (fs::is_regular_file(path, code)) return path.lexically_normal().string();
    }
  }
  if (!fs::exists(nameOrPath, code)) {
    throw Failure("There is no sample " + kind.substr(0, kind.size() - 1) + " and no file named '" +
                  nameOrPath + "'" +
                  (nameOrPath.find('/') == std::string::npos ? namesOf(kind) : "") + ".");
  }
  return nameOrPath;
}

std::string findData(const std::string& name, const std::string& otherwise) {
  std::error_code code;
  for (const fs::path& folder : dataFolders())
    if (fs::is_directory(folder / name, code)) return (folder / name).lexically_normal().string();
  return otherwise;
}

}  // namespace alpenglow::samples
