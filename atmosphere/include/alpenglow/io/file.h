// Whole files: read with a limit, written whole or not at all.
#pragma once

#include <alpenglow/io/result.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace alpenglow::io {

/// Reads a file that is at most `limit` bytes long.
Result<std::string> readFile(const std::string& path, uint64_t limit);

/// Writes `size` bytes. A regular file (or a new one) is written beside its place and renamed, so
/// readers see the old or the new bytes, never a part; a symbolic link is followed. A device or a
/// pipe is written directly, and /dev/stdout, /dev/stderr and /dev/fd/N through the descriptor that
/// is open already, at its place in whatever it belongs to.
Done writeFile(const std::string& path, const void* data, size_t size);

/// Fails early, before hours of work, where writeFile could not write: the folder is missing or
/// read-only, `path` is a folder, or the device is full. Makes a file beside a regular one and
/// removes it again.
Done checkOutput(const std::string& path);

/// As checkOutput, for what a PendingFile is to replace: refuses devices, pipes and open
/// descriptors too.
Done checkReplaceable(const std::string& path);

/// A temporary file beside the regular file that it will replace. Removed by the destructor unless
/// committed. For writers that need a path of their own.
class PendingFile {
 public:
  static Result<PendingFile> create(const std::string& target);
  PendingFile(PendingFile&& other) noexcept;
  PendingFile& operator=(PendingFile&&) = delete;
  ~PendingFile();
  const std::string& path() const { return path_; }
  /// Flushes to the disk and renames over the target.
  Done commit();

 private:
  PendingFile() = default;
  std::string path_;
  std::string target_;
  std::string shown_;  // The target as the caller spelt it, for sentences.
};

/// Removes what the PendingFiles that are alive have written so far. Async-signal-safe: for a
/// program's handler of SIGINT and the like, which then ends it. At most 16 files at once are
/// known.
void removePendingFiles() noexcept;

}  // namespace alpenglow::io
