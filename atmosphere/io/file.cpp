#include <alpenglow/io/file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

namespace alpenglow::io {
namespace {

namespace fs = std::filesystem;

Done cannot(const char* verb, const std::string& path, int code) {
  return {std::string("Cannot ") + verb + " '" + path + "': " + std::strerror(code) + "."};
}

class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }
  int close() { return ::close(std::exchange(fd_, -1)); }

 private:
  int fd_;
};

bool writeAll(int fd, const void* data, size_t size) {
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = ::write(fd, next, size);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    next += n;
    size -= static_cast<size_t>(n);
  }
  return true;
}

// What stands at a path, links followed.
enum class Kind { Nothing, Regular, Folder, Other };

Kind kindOf(const std::string& path, mode_t* mode) {
  struct stat info = {};
  if (::stat(path.c_str(), &info) != 0) return Kind::Nothing;
  *mode = info.st_mode & 07777;
  if (S_ISREG(info.st_mode)) return Kind::Regular;
  return S_ISDIR(info.st_mode) ? Kind::Folder : Kind::Other;
}

// The mode of a file made now by anyone else: 0666 less the umask, which can only be read by
// setting it.
mode_t defaultMode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return static_cast<mode_t>(0666 & ~mask);
}

Done writeDirectly(const std::string& path, const void* data, size_t size) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0 || !writeAll(file.get(), data, size) || file.close() != 0) {
    return cannot("write", path, errno);
  }
  return {};
}

std::string folderOf(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

// Where the bytes will really go: behind symbolic links, even one that points to nothing yet.
std::string resolve(const std::string& path) {
  std::string current = path;
  for (int links = 0; links < 40; ++links) {
    std::error_code code;
    if (!fs::is_symlink(fs::symlink_status(current, code))) return current;
    const fs::path next = fs::read_symlink(current, code);
    if (code) return current;
    current = next.is_absolute() ? next.string() : (fs::path(folderOf(current)) / next).string();
  }
  return current;
}

}  // namespace

Result<std::string> readFile(const std::string& path, uint64_t limit) {
  using Text = Result<std::string>;
  // Opening must not wait for a writer that a FIFO doesn't have; reading must wait for the one it
  // has.
  Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat info = {};
  if (file.get() < 0 || ::fstat(file.get(), &info) != 0 || ::fcntl(file.get(), F_SETFL, 0) != 0) {
    return Text::failure(cannot("read", path, errno).error);
  }
  if (S_ISDIR(info.st_mode)) return Text::failure("Cannot read '" + path + "': it is a folder.");
  const auto tooLong = [&] {
    return Text::failure("The file '" + path + "' is longer than " + std::to_string(limit) +
                         " bytes, the most that is read.");
  };
  if (S_ISREG(info.st_mode) && static_cast<uint64_t>(info.st_size) > limit) return tooLong();
  std::string text;
  if (S_ISREG(info.st_mode)) text.reserve(static_cast<size_t>(info.st_size));
  std::array<char, 1 << 16> chunk;
  for (;;) {
    const ssize_t n = ::read(file.get(), chunk.data(), chunk.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return Text::failure(cannot("read", path, errno).error);
    if (n == 0) return text;
    text.append(chunk.data(), static_cast<size_t>(n));
    if (text.size() > limit) return tooLong();
  }
}

Done checkOutput(const std::string& path) {
  if (path.empty()) return {"The output's name is empty; a path was expected."};
  const std::string target = resolve(path);
  mode_t mode = 0;
  const Kind kind = kindOf(target, &mode);
  if (kind == Kind::Folder) return {"Cannot write '" + path + "': it is a folder."};
  if (kind != Kind::Nothing && ::access(target.c_str(), W_OK) != 0) {
    return cannot("write", path, errno);
  }
  const std::string folder = folderOf(target);
  if (kind != Kind::Other && ::access(folder.c_str(), W_OK | X_OK) != 0) {
    return cannot("write", path, errno);
  }
  if (kind == Kind::Nothing && target.back() == '/') return cannot("write", path, EISDIR);
  return {};
}

Done writeFile(const std::string& path, const void* data, size_t size) {
  mode_t mode = 0;
  if (kindOf(path, &mode) == Kind::Other) return writeDirectly(path, data, size);
  Result<PendingFile> pending = PendingFile::create(path);
  if (!pending) return {pending.error};
  Descriptor file(::open(pending->path().c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0 || !writeAll(file.get(), data, size) || file.close() != 0) {
    return cannot("write", path, errno);
  }
  return pending->commit();
}

Result<PendingFile> PendingFile::create(const std::string& target) {
  const auto failed = [](Done done) { return Result<PendingFile>::failure(std::move(done.error)); };
  if (Done done = checkOutput(target); !done) return failed(std::move(done));
  PendingFile pending;
  pending.shown_ = target;
  pending.target_ = resolve(target);
  mode_t mode = defaultMode();
  if (kindOf(pending.target_, &mode) == Kind::Other) {
    return failed({"Cannot write '" + target + "': it is neither a file nor free."});
  }
  std::string name =
      folderOf(pending.target_) + "/." + fs::path(pending.target_).filename().string();
  name = name.substr(0, 200 + folderOf(pending.target_).size()) + ".part.XXXXXX";
  const Descriptor file(::mkostemp(name.data(), O_CLOEXEC));
  if (file.get() < 0) return failed(cannot("write", target, errno));
  pending.path_ = name;
  ::fchmod(file.get(), mode);
  return pending;
}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : path_(std::exchange(other.path_, {})),
      target_(std::move(other.target_)),
      shown_(std::move(other.shown_)) {}

PendingFile::~PendingFile() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

Done PendingFile::commit() {
  Descriptor file(::open(path_.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0 || ::fsync(file.get()) != 0 || file.close() != 0 ||
      ::rename(path_.c_str(), target_.c_str()) != 0) {
    return cannot("write", shown_, errno);
  }
  path_.clear();
  return {};
}

}  // namespace alpenglow::io
