// Files, descriptors and memory as bytes; above all: no file under its final name before it is
// complete, and none left behind.
#include "bytes.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cstdlib>
#include <thread>
#include <vector>

#include "folder.h"
#include "thrown_by.h"

namespace tetstream::test {
namespace {

// ----------------------------------------------------------------------------------- sinks

TEST(CreateFile, ShowsTheNameOnlyAtCommit) {
  Folder folder;
  const std::string path = folder.file("out");
  const auto sink = createFile(path);
  sink->write("abc", 3);
  EXPECT_EQ(folder.names().count("out"), 0u);
  EXPECT_EQ(folder.names().size(), 1u);  // beside it, so that the rename cannot cross disks
  sink->write("def", 3);
  sink->writeAt(1, "XY", 2);
  EXPECT_TRUE(sink->seekable());
  sink->commit();
  EXPECT_EQ(folder.names(), Names{"out"});
  EXPECT_EQ(contents(path), "aXYdef");
}

// A signal would end the process; nobody ignores it here.
TEST(CreateFile, FailsBeyondTheLimitOfTheProcess) {
  Folder folder;
  struct rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  struct rlimit small = before;
  small.rlim_cur = 4096;
  const auto sink = createFile(folder.file("out"));
  const std::vector<char> data(8192);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto thrown = thrownBy([&] { sink->write(data.data(), data.size()); });
  const auto again = thrownBy([&] { sink->writeAt(5000, data.data(), 10); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_EQ(thrown.first, Status::kIo);
  EXPECT_EQ(again.first, Status::kIo);
}

TEST(CreateFile, LeavesNothingWithoutCommit) {
  Folder folder;
  {
    const auto sink = createFile(folder.file("out"));
    sink->write("abc", 3);
  }
  EXPECT_EQ(folder.names(), Names{});
}

TEST(CreateFile, LeavesTheOldFileAsItWasUntilCommit) {
  Folder folder;
  const std::string path = folder.file("out");
  writeFile(path, "old");
  {
    const auto sink = createFile(path);
    sink->write("new and longer", 14);
    EXPECT_EQ(contents(path), "old");
  }
  EXPECT_EQ(contents(path), "old");
  writeFile(path, "n");
  EXPECT_EQ(contents(path), "n");
  EXPECT_EQ(folder.names(), Names{"out"});
}

TEST(CreateFile, GivesTheRightsThatAreUsual) {
  Folder folder;
  const mode_t mask = ::umask(027);
  writeFile(folder.file("out"), "x");
  ::umask(mask);
  struct stat info;
  ASSERT_EQ(::stat(folder.file("out").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0640u);
}

TEST(CreateFile, SaysWhereItCannot) {
  Folder folder;
  const std::string path = folder.file("none/out");
  const auto [status, text] = thrownBy([&] { createFile(path); });
  EXPECT_EQ(status, Status::kIo);
  EXPECT_EQ(text.find(path), 0u) << text;
  EXPECT_NE(text.find("No such file"), std::string::npos) << text;
  // A folder cannot be written.
  EXPECT_EQ(thrownBy([&] { createFile(folder.path); }).first, Status::kIo);
}

// The name is taken by a folder in the meantime: commit fails, and nothing stays behind.
TEST(CreateFile, CleansUpWhereTheRenameFails) {
  Folder folder;
  const std::string path = folder.file("out");
  {
    const auto sink = createFile(path);
    sink->write("abc", 3);
    ASSERT_EQ(::mkdir(path.c_str(), 0700), 0);
    EXPECT_EQ(thrownBy([&] { sink->commit(); }).first, Status::kIo);
  }
  EXPECT_EQ(folder.names(), Names{"out"});
  ::rmdir(path.c_str());
}

TEST(CreateFile, WritesDevicesDirectly) {
  const auto sink = createFile("/dev/null");
  sink->write("abc", 3);
  EXPECT_FALSE(sink->seekable());
  sink->commit();
  struct stat info;
  ASSERT_EQ(::stat("/dev/null", &info), 0);
  EXPECT_TRUE(S_ISCHR(info.st_mode));
}

TEST(CreateFile, SaysThatADeviceIsFull) {
  if (::access("/dev/full", W_OK) != 0) return;
  const auto sink = createFile("/dev/full");
  EXPECT_EQ(thrownBy([&] { sink->write("abc", 3); }).first, Status::kIo);
}

TEST(CreateMemory, HoldsWhatWasWritten) {
  std::vector<unsigned char> out = {9, 9};
  const auto sink = createMemory(out);
  sink->write("abcdef", 6);
  sink->writeAt(4, "Z", 1);
  sink->write(nullptr, 0);
  sink->commit();
  EXPECT_EQ(std::string(out.begin(), out.end()), "abcdZf");
  EXPECT_EQ(thrownBy([&] { sink->writeAt(6, "x", 1); }).first, Status::kInternal);
  EXPECT_EQ(thrownBy([&] { sink->writeAt(~uint64_t{0}, "x", 1); }).first, Status::kInternal);
}

TEST(BufferedSink, PassesEveryByteOnInOrder) {
  for (size_t capacity : {size_t{1}, size_t{7}, size_t{64}}) {
    std::vector<unsigned char> out;
    const auto sink = createMemory(out);
    std::string wanted;
    BufferedSink buffered(*sink, capacity);
    for (size_t size = 0; size < 100; size += 1 + size / 3) {
      const std::string piece(size, static_cast<char>('a' + size % 26));
      buffered.write(piece.data(), piece.size());
      wanted += piece;
      EXPECT_EQ(buffered.written(), wanted.size());
    }
    buffered.flush();
    buffered.flush();
    EXPECT_EQ(std::string(out.begin(), out.end()), wanted);
  }
}

// ----------------------------------------------------------------------------------- sources

void expectReadable(ByteSource& source, const std::string& text) {
  ASSERT_TRUE(source.seekable());
  EXPECT_EQ(source.size(), text.size());
  char block[64] = {};
  EXPECT_EQ(source.read(block, 2), 2u);
  EXPECT_EQ(source.readAt(1, block, 4), 4u);  // does not move the place
  EXPECT_EQ(std::string(block, 4), text.substr(1, 4));
  EXPECT_EQ(source.readAt(text.size() - 1, block, 10), 1u);
  EXPECT_EQ(source.readAt(text.size(), block, 10), 0u);
  EXPECT_EQ(source.readAt(text.size() + 1000, block, 10), 0u);
  EXPECT_EQ(contents(source), text.substr(2));
  EXPECT_EQ(source.read(block, 5), 0u);
}

TEST(OpenFile, ReadsBothWays) {
  Folder folder;
  writeFile(folder.file("in"), "hello world");
  expectReadable(*openFile(folder.file("in")), "hello world");
  EXPECT_EQ(openFile(folder.file("in"))->name(), folder.file("in"));
}

TEST(OpenFile, SaysWhatIsNotThere) {
  const auto [status, text] = thrownBy([] { openFile("/nowhere/mesh.vtu"); });
  EXPECT_EQ(status, Status::kIo);
  EXPECT_EQ(text.find("/nowhere/mesh.vtu: cannot open"), 0u) << text;
}

TEST(OpenFile, OfAFolderFailsWhenItIsRead) {
  Folder folder;
  EXPECT_EQ(thrownBy([&] { contents(folder.path); }).first, Status::kIo);
}

TEST(OpenMemory, ReadsBothWays) {
  const std::string text = "hello world";
  expectReadable(*openMemory(text.data(), text.size(), "memory"), text);
  const auto none = openMemory(nullptr, 0, "none");
  char block[4];
  EXPECT_EQ(none->read(block, 4), 0u);
}

TEST(OpenDescriptor, DoesNotCloseIt) {
  Folder folder;
  writeFile(folder.file("in"), "hello world");
  const int fd = ::open(folder.file("in").c_str(), O_RDONLY);
  expectReadable(*openDescriptor(fd, "fd"), "hello world");
  EXPECT_EQ(::lseek(fd, 3, SEEK_SET), 3);
  const auto rest = openDescriptor(fd, "fd");
  EXPECT_FALSE(rest->seekable());  // offsets would not be those of the file
  EXPECT_EQ(contents(*rest), "lo world");
  EXPECT_EQ(::close(fd), 0);
  EXPECT_EQ(thrownBy([fd] { openDescriptor(fd, "closed"); }).first, Status::kIo);
}

TEST(MakeSeekable, SpoolsAPipe) {
  int fds[2];
  ASSERT_EQ(::pipe(fds), 0);
  std::string text;
  for (int k = 0; k < 40000; ++k) text += static_cast<char>('a' + k * k % 26);
  std::thread writer([&] {
    const auto sink = createDescriptor(fds[1], "pipe");
    EXPECT_FALSE(sink->seekable());
    for (size_t at = 0; at < text.size(); at += 1000) sink->write(text.data() + at, 1000);
    sink->commit();
    ::close(fds[1]);
  });
  auto pipe = openDescriptor(fds[0], "pipe");
  EXPECT_FALSE(pipe->seekable());
  const auto source = makeSeekable(std::move(pipe), ::testing::TempDir());
  writer.join();
  ::close(fds[0]);
  EXPECT_EQ(source->name(), "pipe");
  expectReadable(*source, text);
}

TEST(MakeSeekable, LeavesAFileAsItIs) {
  const std::string text = "abc";
  auto source = openMemory(text.data(), 3, "m");
  const ByteSource* before = source.get();
  EXPECT_EQ(makeSeekable(std::move(source), "/nowhere").get(), before);
}

// ------------------------------------------------------------------------------------- spool

TEST(SpoolFile, HasNoNameAndGivesBackWhatWasAppended) {
  Folder folder;
  SpoolFile spool(folder.path);
  EXPECT_EQ(folder.names(), Names{});
  spool.append("abc", 3);
  spool.append("defg", 4);
  EXPECT_EQ(spool.size(), 7u);
  char block[8] = {};
  spool.readAt(2, block, 3);
  EXPECT_EQ(std::string(block, 3), "cde");
  spool.append("h", 1);
  spool.readAt(6, block, 2);
  EXPECT_EQ(std::string(block, 2), "gh");
  EXPECT_EQ(thrownBy([&] { spool.readAt(6, block, 3); }).first, Status::kIo);
}

TEST(SpoolFile, SaysWhichFolderItCannotUse) {
  const auto [status, text] = thrownBy([] { SpoolFile spool("/nowhere"); });
  EXPECT_EQ(status, Status::kIo);
  EXPECT_EQ(text.find("/nowhere/"), 0u) << text;
}

TEST(CreateFile, TakesTheLongestNames) {
  const Folder folder;
  const std::string name(255, 'n');
  writeFile(folder.file(name), "mesh");
  EXPECT_EQ(contents(folder.file(name)), "mesh");
  EXPECT_EQ(folder.names(), Names{name});
}

TEST(CreateFile, KeepsTheModeOfWhatItReplaces) {
  const Folder folder;
  writeFile(folder.file("private"), "old");
  ASSERT_EQ(::chmod(folder.file("private").c_str(), 0600), 0);
  writeFile(folder.file("private"), "new");
  struct stat info;
  ASSERT_EQ(::stat(folder.file("private").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 07777, 0600u);
}

// Nobody holds a lock on it any more: removed. Somebody does, or it has another name: not.
TEST(CreateFile, RemovesWhatAKilledProcessLeft) {
  const Folder folder;
  const Names others = {"out.tetstream-x", "out.tetstream-1", "about.tetstream-1-0",
                        "out.20261127-153000"};  // dates are no numbers of processes
  Names before = others;
  before.insert({"out.tetstream-1a2b-0", "out.tetstream-1a2b-1"});
  for (const std::string& left : before) writeFile(folder.file(left), "left");
  const int fd = ::open(folder.file("out.tetstream-1a2b-1").c_str(), O_RDWR);
  ASSERT_EQ(::flock(fd, LOCK_EX), 0);
  writeFile(folder.file("out"), "new");
  Names expected = others;
  expected.insert("out");
  const Names after = expected;
  expected.insert("out.tetstream-1a2b-1");
  EXPECT_EQ(folder.names(), expected);
  ::close(fd);
  writeFile(folder.file("out"), "newer");
  EXPECT_EQ(folder.names(), after);
}

// Two of the same name at once: neither takes the other's for abandoned.
TEST(CreateFile, LeavesWhatIsBeingWritten) {
  const Folder folder;
  const auto first = createFile(folder.file("out")), second = createFile(folder.file("out"));
  EXPECT_EQ(folder.names().size(), 2u);
  first->commit();
  second->commit();
  EXPECT_EQ(folder.names(), Names{"out"});
}

TEST(CreateFile, WritesThroughALink) {
  const Folder folder;
  writeFile(folder.file("file"), "old");
  ASSERT_EQ(::symlink("file", folder.file("link").c_str()), 0);
  writeFile(folder.file("link"), "new");
  EXPECT_EQ(contents(folder.file("file")), "new");
  struct stat info;
  ASSERT_EQ(::lstat(folder.file("link").c_str(), &info), 0);
  EXPECT_TRUE(S_ISLNK(info.st_mode));
}

TEST(CreateFile, MakesWhatALinkLeadsTo) {
  const Folder folder;
  ASSERT_EQ(::symlink("second", folder.file("first").c_str()), 0);
  ASSERT_EQ(::symlink("file", folder.file("second").c_str()), 0);
  writeFile(folder.file("first"), "new");
  EXPECT_EQ(folder.names(), (Names{"first", "second", "file"}));
  EXPECT_EQ(contents(folder.file("file")), "new");
}

// The file stays, with what it has: nothing else could be told by those who have it open.
TEST(CreateFile, WritesToDescriptorsFromWhereTheyAre) {
  const Folder folder;
  writeFile(folder.file("log"), "before ");
  const int fd = ::open(folder.file("log").c_str(), O_WRONLY | O_APPEND);
  ASSERT_GE(fd, 0);
  ASSERT_EQ(::symlink(("/dev/fd/" + std::to_string(fd)).c_str(), folder.file("link").c_str()), 0);
  writeFile("/dev/fd/" + std::to_string(fd), "between ");
  writeFile(folder.file("link"), "after");
  EXPECT_EQ(contents(folder.file("log")), "before between after");
  EXPECT_EQ(::close(fd), 0);
  EXPECT_EQ(thrownBy([&] { createFile(folder.file("link")); }).first, Status::kIo);
}

// By somebody whom it stops, which the superuser is not.
TEST(CreateFile, LeavesWhatMayNotBeWritten) {
  const Folder folder;
  writeFile(folder.file("done"), "old");
  ASSERT_EQ(::chmod(folder.path.c_str(), 0777), 0);
  ASSERT_EQ(::chmod(folder.file("done").c_str(), 0444), 0);
  const uid_t before = ::geteuid();
  const uid_t other = before == 0 ? 65534 : before;
  ASSERT_EQ(::seteuid(other), 0);
  const auto [status, text] = thrownBy([&] { createFile(folder.file("done")); });
  ASSERT_EQ(::seteuid(before), 0);
  EXPECT_EQ(status, Status::kIo);
  EXPECT_NE(text.find("/done: cannot write: Permission denied"), std::string::npos) << text;
  EXPECT_EQ(folder.names(), Names{"done"});
  EXPECT_EQ(contents(folder.file("done")), "old");
}

// ----------------------------------------------------------------------------- read again

TEST(ReadAgain, StartsAtTheFirstByteAndMovesNothing) {
  Folder folder;
  const std::string text = "twenty-six letters and so on";
  writeFile(folder.file("in"), text);
  for (const bool from_file : {false, true}) {
    const auto source =
        from_file ? openFile(folder.file("in")) : openMemory(text.data(), text.size(), "memory");
    char start[5] = {};
    ASSERT_EQ(source->read(start, 4), 4u);
    const auto again = readAgain(*source);
    EXPECT_TRUE(again->seekable());
    EXPECT_EQ(again->size(), text.size());
    EXPECT_EQ(again->name(), source->name());
    EXPECT_EQ(contents(*again), text);
    EXPECT_EQ(again->readAt(7, start, 3), 3u);
    EXPECT_EQ(std::string(start, 3), text.substr(7, 3));
    EXPECT_EQ(again->read(start, 1), 0u);
    EXPECT_EQ(contents(*source), text.substr(4));
    EXPECT_EQ(contents(*readAgain(*readAgain(*source))), text);
  }
}

}  // namespace
}  // namespace tetstream::test
