#include <alpenglow/io/file.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
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
    if (n < 0 && errno == EAGAIN) {  // An inherited pipe may not block.
      pollfd ready = {fd, POLLOUT, 0};
      ::poll(&ready, 1, -1);
      continue;
    }
    if (n <= 0) return false;
    next += n;
    size -= static_cast<size_t>(n);
  }
  return true;
}

// What stands at a path, links followed. Failed: the file's type is unknown, see errno.
enum class Kind { Nothing, Regular, Folder, Pipe, Other, Failed };

Kind kindOf(const std::string& path, mode_t* mode) {
  struct stat info = {};
  if (::stat(path.c_str(), &info) != 0) return errno == ENOENT ? Kind::Nothing : Kind::Failed;
  *mode = info.st_mode & 07777;
  if (S_ISREG(info.st_mode)) return Kind::Regular;
  if (S_ISFIFO(info.st_mode)) return Kind::Pipe;
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

// The number in "/dev/fd/N", whatever the folder is called, as long as it lists this process's
// descriptors; else -1.
int descriptorOf(const std::string& path) {
  const std::string name = fs::path(path).filename().string();
  const bool number = !name.empty() && name.size() <= 9 &&
                      name.find_first_not_of("0123456789") == std::string::npos;
  if (!number) return -1;
  std::error_code code;
  const fs::path all = fs::canonical("/proc/self/fd", code);
  if (code || fs::canonical(folderOf(path), code) != all) return -1;
  return std::stoi(name);
}

// Where the bytes will really go: behind symbolic links, even one that points to nothing yet.
struct Place {
  std::string path;
  // What /dev/stdout and /dev/fd/N stand for. The file behind one belongs to whoever opened it: it
  // goes on at its offset, and must not be replaced or reopened.
  int descriptor = -1;
};

Place resolve(const std::string& path) {
  Place place = {path, -1};
  for (int links = 0; links < 40; ++links) {
    std::string& current = place.path;
    place.descriptor = descriptorOf(current);
    std::error_code code;
    if (place.descriptor >= 0 || !fs::is_symlink(fs::symlink_status(current, code))) return place;
    const fs::path next = fs::read_symlink(current, code);
    if (code) return place;
    current = next.is_absolute() ? next.string() : (fs::path(folderOf(current)) / next).string();
  }
  return place;
}

// A write of nothing, which a full device refuses and others ignore; a socket might send it on.
bool acceptsBytes(int fd) {
  struct stat info = {};
  return ::fstat(fd, &info) == 0 && (!S_ISCHR(info.st_mode) || ::write(fd, "", 0) == 0);
}

Done checkDescriptor(const std::string& path, int fd) {
  const int flags = ::fcntl(fd, F_GETFL);
  if (flags < 0) return cannot("write", path, errno);
  if ((flags & O_ACCMODE) == O_RDONLY) return cannot("write", path, EBADF);
  return acceptsBytes(fd) ? Done{} : cannot("write", path, errno);
}

// Of what is neither a file nor a pipe, which would wait for a reader here.
Done checkDevice(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (file.get() < 0 || !acceptsBytes(file.get())) return cannot("write", path, errno);
  return {};
}

// Makes a file beside the target, under a name of its own. Negative on failure, see errno.
int openBeside(const std::string& target, std::string* name) {
  const std::string folder = folderOf(target);
  *name = folder + "/." + fs::path(target).filename().string();
  *name = name->substr(0, 200 + folder.size()) + ".part.XXXXXX";
  return ::mkostemp(name->data(), O_CLOEXEC);
}

// Permissions alone don't tell: root has them all, and yet can't make a file in /proc.
Done checkFolder(const std::string& path, const std::string& target) {
  std::string name;
  const Descriptor file(openBeside(target, &name));
  if (file.get() < 0 || ::unlink(name.c_str()) != 0) return cannot("write", path, errno);
  return {};
}

// Paths of pending files, for a signal handler: no allocation, no lock. A slot's text is written
// while it is taken and not ready, and read only while it is ready.
struct PendingSlot {
  enum State : int { Free, Taken, Ready };
  std::atomic<int> state = Free;
  char path[PATH_MAX] = {};
};
PendingSlot pendingSlots[16];
static_assert(std::atomic<int>::is_always_lock_free, "Handlers of signals read it.");

void rememberPending(const std::string& path) {
  if (path.size() >= PATH_MAX) return;
  for (PendingSlot& slot : pendingSlots) {
    int state = PendingSlot::Free;
    if (!slot.state.compare_exchange_strong(state, PendingSlot::Taken)) continue;
    std::memcpy(slot.path, path.c_str(), path.size() + 1);
    slot.state = PendingSlot::Ready;
    return;
  }
}

void forgetPending(const std::string& path) {
  for (PendingSlot& slot : pendingSlots) {
    if (slot.state != PendingSlot::Ready || path != slot.path) continue;
    slot.state = PendingSlot::Free;
    return;
  }
}

}  // namespace

void removePendingFiles() noexcept {
  for (PendingSlot& slot : pendingSlots)
    if (slot.state == PendingSlot::Ready) ::unlink(slot.path);
}

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
  const Place place = resolve(path);
  if (place.descriptor >= 0) return checkDescriptor(path, place.descriptor);
  mode_t mode = 0;
  const Kind kind = kindOf(place.path, &mode);
  if (kind == Kind::Failed) return cannot("write", path, errno);
  if (kind == Kind::Folder) return {"Cannot write '" + path + "': it is a folder."};
  if (kind == Kind::Nothing && place.path.back() == '/') return cannot("write", path, EISDIR);
  if (kind != Kind::Nothing && ::access(place.path.c_str(), W_OK) != 0) {
    return cannot("write", path, errno);
  }
  if (kind == Kind::Pipe) return {};
  return kind == Kind::Other ? checkDevice(path) : checkFolder(path, place.path);
}

Done checkReplaceable(const std::string& path) {
  const Place place = resolve(path);
  mode_t mode = 0;
  const Kind kind = kindOf(place.path, &mode);
  if (place.descriptor >= 0 || kind == Kind::Pipe || kind == Kind::Other) {
    return {"Cannot write '" + path +
            "': it is a device, a pipe or an open descriptor, but a file is needed."};
  }
  return checkOutput(path);
}

Done writeFile(const std::string& path, const void* data, size_t size) {
  const Place place = resolve(path);
  if (place.descriptor >= 0) {
    const bool written = writeAll(place.descriptor, data, size);
    return written ? Done{} : cannot("write", path, errno);
  }
  mode_t mode = 0;
  const Kind kind = kindOf(place.path, &mode);
  if (kind == Kind::Pipe || kind == Kind::Other) return writeDirectly(path, data, size);
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
  if (Done done = checkReplaceable(target); !done) return failed(std::move(done));
  PendingFile pending;
  pending.shown_ = target;
  pending.target_ = resolve(target).path;
  mode_t mode = defaultMode();
  kindOf(pending.target_, &mode);  // An old file's mode stays.
  std::string name;
  const Descriptor file(openBeside(pending.target_, &name));
  if (file.get() < 0) return failed(cannot("write", target, errno));
  pending.path_ = name;
  rememberPending(name);
  ::fchmod(file.get(), mode);
  return pending;
}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : path_(std::exchange(other.path_, {})),
      target_(std::move(other.target_)),
      shown_(std::move(other.shown_)) {}

PendingFile::~PendingFile() {
  if (path_.empty()) return;
  ::unlink(path_.c_str());
  forgetPending(path_);
}

Done PendingFile::commit() {
  Descriptor file(::open(path_.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0 || ::fsync(file.get()) != 0 || file.close() != 0 ||
      ::rename(path_.c_str(), target_.c_str()) != 0) {
    return cannot("write", shown_, errno);
  }
  forgetPending(path_);
  path_.clear();
  return {};
}

}  // namespace alpenglow::io
