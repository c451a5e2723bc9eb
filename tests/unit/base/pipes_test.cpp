// Pipes and other descriptors at which somebody else stands: waits, and who is no longer there.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string>
#include <thread>

#include "folder.h"
#include "thrown_by.h"

namespace tetstream::test {
namespace {

TEST(CreateDescriptor, FailsWhereNobodyReads) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_EQ(::close(ends[0]), 0);
  const auto sink = createDescriptor(ends[1], "a pipe");
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(thrownBy([&] { sink->write("abc", 3); }).first, Status::kIo);
  sigset_t pending;
  ASSERT_EQ(::sigpending(&pending), 0);
  EXPECT_EQ(::sigismember(&pending, SIGPIPE), 0);
  EXPECT_EQ(::close(ends[1]), 0);
}

#ifdef F_SETPIPE_SZ
TEST(Pipes, AreMadeWideAtEitherEnd) {
  for (const bool reads : {true, false}) {
    int fds[2], others[2];
    ASSERT_EQ(::pipe(fds), 0);
    ASSERT_EQ(::pipe(others), 0);
    if (reads)
      openDescriptor(fds[0], "pipe");
    else
      createDescriptor(fds[1], "pipe");
    ::fcntl(others[0], F_SETPIPE_SZ, 1 << 20);  // a system may refuse
    EXPECT_EQ(::fcntl(fds[0], F_GETPIPE_SZ), ::fcntl(others[0], F_GETPIPE_SZ));
    for (int fd : {fds[0], fds[1], others[0], others[1]}) ::close(fd);
  }
}
#endif

// Before anything is done, not when it is to be written.
TEST(Descriptors, AreRefusedWhereTheyAreOpenTheOtherWay) {
  int fds[2];
  ASSERT_EQ(::pipe(fds), 0);
  const auto said = [](auto&& make) { return thrownBy(make).second; };
  const std::string closed = std::strerror(EBADF);
  EXPECT_EQ(said([&] { openDescriptor(fds[1], "end"); }), "end: cannot read: " + closed);
  EXPECT_EQ(said([&] { createDescriptor(fds[0], "end"); }), "end: cannot write: " + closed);
  const std::string own = "/dev/fd/" + std::to_string(fds[0]);
  EXPECT_EQ(thrownBy([&] { createFile(own, nullptr); }).first, Status::kIo);
  for (const int fd : fds) ::close(fd);
  EXPECT_EQ(thrownBy([&] { openDescriptor(-1, "none"); }).first, Status::kIo);
  EXPECT_EQ(thrownBy([&] { createDescriptor(-1, "none"); }).first, Status::kIo);
}

TEST(Waiting, IsOfWhatHasAnotherEnd) {
  Folder folder;
  writeFile(folder.file("in"), "abc");
  EXPECT_FALSE(openFile(folder.file("in"))->waiting());
  EXPECT_FALSE(openMemory("abc", 3, "memory")->waiting());
  int fds[2];
  ASSERT_EQ(::pipe(fds), 0);
  auto pipe = openDescriptor(fds[0], "pipe");
  const std::shared_ptr<Waiting> waiting = pipe->waiting();
  ASSERT_TRUE(waiting);
  EXPECT_EQ(withPrefix({'a'}, std::move(pipe))->waiting(), waiting);
  for (const int fd : fds) ::close(fd);
}

TEST(Waiting, CanBeEndedByAnotherThread) {
  int fds[2];
  ASSERT_EQ(::pipe(fds), 0);
  const auto pipe = openDescriptor(fds[0], "pipe");
  const auto thrown = [&] {
    return thrownBy([&] {
      char byte;
      pipe->read(&byte, 1);
    });
  };
  const std::pair<Status, std::string> ended = {Status::kCancelled,
                                                "pipe: nobody waits for it any more"};
  std::thread reader([&] { EXPECT_EQ(thrown(), ended); });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  pipe->waiting()->end();
  reader.join();
  EXPECT_EQ(::write(fds[1], "a", 1), 1);
  EXPECT_EQ(thrown(), ended);
  for (const int fd : fds) ::close(fd);
}

// What it throws ends the waiting. Another thread that waits leaves it alone.
TEST(Waiting, LeavesTimeForSomethingElse) {
  int fds[2];
  ASSERT_EQ(::pipe(fds), 0);
  const auto pipe = openDescriptor(fds[0], "pipe");
  int times = 0;
  pipe->waiting()->doMeanwhile([&] {
    if (++times == 3) fail(Status::kCancelled, "enough");
  });
  char byte = 0;
  EXPECT_EQ(thrownBy([&] { pipe->read(&byte, 1); }).second, "enough");
  EXPECT_EQ(times, 3);
  std::thread reader([&] { EXPECT_EQ(pipe->read(&byte, 1), 1u); });
  std::this_thread::sleep_for(std::chrono::milliseconds(3 * Waiting::kMilliseconds));
  EXPECT_EQ(::write(fds[1], "a", 1), 1);
  reader.join();
  EXPECT_EQ(times, 3);
  for (const int fd : fds) ::close(fd);
}

// Others may have made them so; a read that would not wait is none that failed.
TEST(Waiting, IsDoneForDescriptorsThatDoNot) {
  int fds[2];
  ASSERT_EQ(::pipe(fds), 0);
  ASSERT_EQ(::fcntl(fds[0], F_SETFL, O_NONBLOCK), 0);
  std::thread writer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(::write(fds[1], "late", 4), 4);
    ::close(fds[1]);
  });
  EXPECT_EQ(contents(*openDescriptor(fds[0], "pipe")), "late");
  writer.join();
  ::close(fds[0]);
}

TEST(CreateDescriptor, WaitsForDescriptorsThatDoNot) {
  int fds[2];
  ASSERT_EQ(::pipe(fds), 0);
  ASSERT_EQ(::fcntl(fds[1], F_SETFL, O_NONBLOCK), 0);
  const std::string text(3 << 20, 'x');  // more than a pipe holds
  std::thread writer([&] {
    const auto sink = createDescriptor(fds[1], "pipe");
    EXPECT_NO_THROW(sink->write(text.data(), text.size()));
    ::close(fds[1]);
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(contents(*openDescriptor(fds[0], "pipe")).size(), text.size());
  writer.join();
  ::close(fds[0]);
}

}  // namespace
}  // namespace tetstream::test
