#include <alpenglow/io/file.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <iterator>
#include <thread>
#include <vector>

#include "temporary_folder.h"

namespace alpenglow::io {
namespace {

using test::contentsOf;
using test::expectSentence;
using test::TemporaryFolder;

Done writeText(const std::string& path, const std::string& text) {
  return writeFile(path, text.data(), text.size());
}

TEST(WholeFile, WritesNewAndReplacesOld) {
  TemporaryFolder folder;
  ASSERT_TRUE(writeText(folder / "a", "first"));
  EXPECT_EQ(contentsOf(folder / "a"), "first");
  ASSERT_EQ(::chmod((folder / "a").c_str(), 0640), 0);
  ASSERT_TRUE(writeText(folder / "a", "second, longer"));
  EXPECT_EQ(contentsOf(folder / "a"), "second, longer");
  struct stat info = {};
  ASSERT_EQ(::stat((folder / "a").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 07777, 0640u);
  EXPECT_EQ(folder.names().size(), 1u);
  EXPECT_EQ(*readFile(folder / "a", 100), "second, longer");
}

TEST(WholeFile, ReplacesByRename) {
  TemporaryFolder folder;
  ASSERT_TRUE(writeText(folder / "a", "old"));
  std::ifstream open(folder / "a");
  ASSERT_TRUE(writeText(folder / "a", "new"));
  std::string seen;
  open >> seen;
  EXPECT_EQ(seen, "old");  // Who had it open keeps the old file.
}

TEST(WholeFile, FollowsSymbolicLinks) {
  TemporaryFolder folder;
  folder.write("real", "old");
  ASSERT_EQ(::symlink("real", (folder / "link").c_str()), 0);
  ASSERT_EQ(::symlink("later", (folder / "dangling").c_str()), 0);
  ASSERT_TRUE(writeText(folder / "link", "new"));
  EXPECT_EQ(contentsOf(folder / "real"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  ASSERT_TRUE(writeText(folder / "dangling", "made"));
  EXPECT_EQ(contentsOf(folder / "later"), "made");
}

TEST(WholeFile, RefusesFoldersAndMissingFolders) {
  TemporaryFolder folder;
  for (const std::string& path : {folder.path(), folder / "no/such/file", std::string()}) {
    expectSentence(writeText(path, "x").error);
    expectSentence(checkOutput(path).error);
    EXPECT_FALSE(PendingFile::create(path));
  }
  EXPECT_TRUE(checkOutput(folder / "fine"));
  EXPECT_TRUE(folder.names().empty());
}

TEST(WholeFile, AFullDeviceIsReported) {
  const Done done = writeText("/dev/full", "x");
  expectSentence(done.error);
  EXPECT_NE(done.error.find("No space left"), std::string::npos) << done.error;
  EXPECT_NE(checkOutput("/dev/full").error.find("No space left"), std::string::npos);
  EXPECT_TRUE(checkOutput("/dev/null"));
  EXPECT_TRUE(writeText("/dev/null", "x"));
  EXPECT_FALSE(PendingFile::create("/dev/full"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

// What was written before and what comes after by the same descriptor must stay.
TEST(WholeFile, AnOpenDescriptorGoesOnAtItsPlace) {
  TemporaryFolder folder;
  const int fd = ::open((folder / "log").c_str(), O_WRONLY | O_CREAT, 0600);
  ASSERT_GE(fd, 0);
  const std::string name = "/dev/fd/" + std::to_string(fd);
  ASSERT_EQ(::symlink(name.c_str(), (folder / "link").c_str()), 0);
  ASSERT_EQ(::write(fd, "before ", 7), 7);
  EXPECT_TRUE(checkOutput(name));
  EXPECT_TRUE(writeText(name, "one "));
  EXPECT_TRUE(writeText("/proc/self/fd/" + std::to_string(fd), "two "));
  EXPECT_TRUE(writeText(folder / "link", "three "));
  ASSERT_EQ(::write(fd, "after", 5), 5);
  EXPECT_EQ(contentsOf(folder / "log"), "before one two three after");
  expectSentence(checkReplaceable(name).error);
  EXPECT_FALSE(PendingFile::create(name));
  EXPECT_EQ(folder.names().size(), 2u);
  ::close(fd);
  expectSentence(checkOutput(name).error);
  expectSentence(writeText(name, "x").error);
}

TEST(WholeFile, ADescriptorForReadingIsRefused) {
  TemporaryFolder folder;
  const int fd = ::open(folder.write("in", "kept").c_str(), O_RDONLY);
  ASSERT_GE(fd, 0);
  expectSentence(checkOutput("/dev/fd/" + std::to_string(fd)).error);
  expectSentence(writeText("/dev/fd/" + std::to_string(fd), "x").error);
  ::close(fd);
  EXPECT_EQ(contentsOf(folder / "in"), "kept");
}

TEST(WholeFile, UnwritablePathsAreReportedEarly) {
  TemporaryFolder folder;
  folder.write("file", "x");
  for (const std::string& path :
       {std::string("/proc/new"), folder / "file/new", folder / std::string(300, 'x')}) {
    expectSentence(checkOutput(path).error);
  }
  ASSERT_EQ(::symlink("loop", (folder / "loop").c_str()), 0);
  expectSentence(checkOutput(folder / "loop").error);
  EXPECT_EQ(folder.names().size(), 2u);
}

TEST(WholeFile, OnlyFilesAreReplaceable) {
  TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_TRUE(checkOutput(folder / "pipe"));
  for (const std::string& path :
       {std::string("/dev/null"), std::string("/dev/full"), std::string("/dev/stdout"),
        folder / "pipe", folder.path(), folder / "no/such/file", std::string()}) {
    expectSentence(checkReplaceable(path).error);
  }
  EXPECT_TRUE(checkReplaceable(folder / "fine"));
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST(WholeFile, APendingFileThatIsDroppedLeavesNothing) {
  TemporaryFolder folder;
  folder.write("a", "old");
  {
    Result<PendingFile> pending = PendingFile::create(folder / "a");
    ASSERT_TRUE(pending) << pending.error;
    std::ofstream(pending->path()) << "half";
    EXPECT_EQ(folder.names().size(), 2u);
  }
  EXPECT_EQ(folder.names().size(), 1u);
  EXPECT_EQ(contentsOf(folder / "a"), "old");
}

// As a handler of SIGINT does, with more files than are known.
TEST(WholeFile, PendingFilesAreRemovedAtOnce) {
  const TemporaryFolder folder;
  const auto files = [&] {
    const std::filesystem::directory_iterator all(folder / "");
    return std::distance(begin(all), end(all));
  };
  {
    std::vector<PendingFile> pending;
    for (int i = 0; i < 20; ++i) {
      Result<PendingFile> made = PendingFile::create(folder / ("f" + std::to_string(i)));
      ASSERT_TRUE(made) << made.error;
      pending.push_back(std::move(*made));
    }
    EXPECT_EQ(files(), 20);
    removePendingFiles();
    EXPECT_EQ(files(), 4);
  }
  EXPECT_EQ(files(), 0);
  Result<PendingFile> kept = PendingFile::create(folder / "kept");
  ASSERT_TRUE(kept) << kept.error;
  ASSERT_TRUE(kept->commit());
  removePendingFiles();
  EXPECT_EQ(files(), 1);
}

TEST(ReadFile, StopsAtItsLimit) {
  TemporaryFolder folder;
  const std::string path = folder.write("a", std::string(100, 'x'));
  EXPECT_EQ(readFile(path, 100)->size(), 100u);
  EXPECT_NE(readFile(path, 99).error.find("longer than 99 bytes"), std::string::npos);
  expectSentence(readFile("/dev/zero", 1000).error);
  expectSentence(readFile(folder / "absent", 10).error);
  expectSentence(readFile(folder.path(), 10).error);
}

TEST(ReadFile, WaitsForAPipesWriter) {
  int ends[2] = {};
  ASSERT_EQ(::pipe(ends), 0);
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(::write(ends[1], "late", 4), 4);
    ::close(ends[1]);
  });
  const Result<std::string> text = readFile("/dev/fd/" + std::to_string(ends[0]), 10);
  writer.join();
  ::close(ends[0]);
  ASSERT_TRUE(text) << text.error;
  EXPECT_EQ(*text, "late");
}

}  // namespace
}  // namespace alpenglow::io
