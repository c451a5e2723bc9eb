// A file that replaces another one: who may read it meanwhile, and that it is on the disk before.
#include "named_temporary.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

#include "folder.h"
#include "thrown_by.h"

namespace {

// What the library calls comes here first.
mode_t mode_before_chmod = 0;
bool all_are_open = false;
int chmod_fails_with = 0, sync_fails_with = 0, syncs = 0;

}  // namespace

extern "C" int fchmod(int fd, mode_t mode) {
  struct stat made = {};
  ::fstat(fd, &made);
  mode_before_chmod = made.st_mode & 0777;
  errno = chmod_fails_with;
  return chmod_fails_with ? -1 : static_cast<int>(::syscall(SYS_fchmod, fd, mode));
}

extern "C" int fstat(int fd, struct stat* is) {
  const int result = ::fstatat(fd, "", is, AT_EMPTY_PATH);
  if (all_are_open) is->st_mode |= 0777;
  return result;
}

extern "C" int fdatasync(int fd) {
  ++syncs;
  errno = sync_fails_with;
  return sync_fails_with ? -1 : static_cast<int>(::syscall(SYS_fdatasync, fd));
}

namespace tetstream::test {
namespace {

mode_t modeOf(const std::string& path) {
  struct stat is = {};
  ::stat(path.c_str(), &is);
  return is.st_mode & 07777;
}

class NamedTemporaryTest : public ::testing::Test {
 protected:
  NamedTemporaryTest() : mask_(::umask(0)) {
    mode_before_chmod = 0;
    all_are_open = false;
    chmod_fails_with = sync_fails_with = syncs = 0;
    writeFile(old, "old");
    ::chmod(old.c_str(), 0640);
  }
  ~NamedTemporaryTest() override { ::umask(mask_); }

  // The status of replacing the old file, and of committing that.
  Status replace() {
    return thrownBy([&] { writeFile(old, "new"); }).first;
  }

  Folder folder;
  const std::string old = folder.file("a");

 private:
  mode_t mask_;
};

TEST_F(NamedTemporaryTest, IsNeverOpenerThanWhatItReplaces) {
  EXPECT_EQ(replace(), Status::kOk);
  EXPECT_EQ(mode_before_chmod, 0640u);
  EXPECT_EQ(modeOf(old), 0640u);
}

TEST_F(NamedTemporaryTest, KeepsBitsThatTheMaskWouldTake) {
  ::umask(077);
  EXPECT_EQ(replace(), Status::kOk);
  EXPECT_EQ(modeOf(old), 0640u);
}

// As on file systems that have no modes.
TEST_F(NamedTemporaryTest, IsWrittenWhereModesCannotBeSet) {
  chmod_fails_with = EPERM;
  EXPECT_EQ(replace(), Status::kOk);
  EXPECT_EQ(contents(old), "new");
}

TEST_F(NamedTemporaryTest, IsNotWrittenWhereOthersCouldReadWhatTheyCouldNot) {
  chmod_fails_with = EPERM;
  all_are_open = true;
  EXPECT_EQ(replace(), Status::kIo);
  EXPECT_EQ(contents(old), "old");
  EXPECT_EQ(folder.names(), Names{"a"});
}

TEST_F(NamedTemporaryTest, IsOnTheDiskBeforeItReplacesAFile) {
  EXPECT_EQ(syncs, 0);  // of a new one
  EXPECT_EQ(replace(), Status::kOk);
  EXPECT_EQ(syncs, 1);
}

TEST_F(NamedTemporaryTest, LeavesTheOldFileWhereTheDiskFails) {
  sync_fails_with = EIO;
  EXPECT_EQ(replace(), Status::kIo);
  EXPECT_EQ(contents(old), "old");
  EXPECT_EQ(folder.names(), Names{"a"});
  sync_fails_with = EINVAL;  // a file system that has nothing to do
  EXPECT_EQ(replace(), Status::kOk);
}

}  // namespace
}  // namespace tetstream::test
