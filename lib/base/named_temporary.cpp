#include "named_temporary.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <memory>

#include "final_place.h"
#include "io_error.h"

namespace tetstream {

static bool isLockedBySomebody(int fd) {
  return ::flock(fd, LOCK_EX | LOCK_NB) != 0;  // as is one that cannot be locked at all
}

// Behind the name of what is written; no file of somebody else's ends like that.
constexpr const char* kMark = ".tetstream-";

// The mark and "<process>-<attempt>", hexadecimal.
static bool isSuffix(const char* text) {
  constexpr const char* kDigits = "0123456789abcdef";
  if (std::strncmp(text, kMark, std::strlen(kMark)) != 0) return false;
  text += std::strlen(kMark);
  const size_t process = std::strspn(text, kDigits);
  if (process == 0 || text[process] != '-') return false;
  text += process + 1;
  const size_t attempt = std::strspn(text, kDigits);
  return attempt > 0 && text[attempt] == '\0';
}

// What others left there when they were killed.
static void removeAbandoned(const std::string& stem) {
  const size_t slash = stem.find_last_of('/') + 1;
  const std::string folder = slash ? stem.substr(0, slash) : "./", base = stem.substr(slash);
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(::opendir(folder.c_str()), ::closedir);
  if (!entries) return;
  while (const dirent* entry = ::readdir(entries.get())) {
    if (std::strncmp(entry->d_name, base.c_str(), base.size()) != 0 ||
        !isSuffix(entry->d_name + base.size()))
      continue;
    const std::string path = folder + entry->d_name;
    const int fd = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (fd < 0) continue;
    if (!isLockedBySomebody(fd)) ::unlink(path.c_str());
    ::close(fd);
  }
}

// Whether the name still is this file's: between its creation and its lock somebody may have taken
// it for abandoned.
static bool isStillThere(int fd, const std::string& path) {
  struct stat ours, named;
  return ::fstat(fd, &ours) == 0 && ::stat(path.c_str(), &named) == 0 &&
         ours.st_ino == named.st_ino && ours.st_dev == named.st_dev;
}

constexpr unsigned kAttempts = 1000;

void NamedTemporary::create(const std::string& stem, unsigned mode) {
  // note: not mkstemp, which would not give the file the mode that the user's umask allows.
  for (unsigned attempt = 0; attempt < kAttempts; ++attempt) {
    temporary_ = textOf("%s%s%lx-%x", stem.c_str(), kMark, static_cast<long>(::getpid()), attempt);
    fd_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (fd_ < 0 && errno == EEXIST) continue;
    if (fd_ < 0) failIo(path_, "create");
    const bool taken = ::flock(fd_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!taken && isStillThere(fd_, temporary_)) return;
    ::unlink(temporary_.c_str());
    ::close(fd_);
    fd_ = -1;
  }
  fail(Status::kIo, "%s: no temporary file beside it stays there", path_.c_str());
}

// Whether somebody may do with it what he could not with the old one. Where modes cannot be set, as
// on file systems that have none, all files have the same, and writing goes on.
static bool isOpenerThan(const struct stat& old, int fd) {
  struct stat made;
  return ::fstat(fd, &made) != 0 || (made.st_mode & 0777 & ~old.st_mode) != 0;
}

NamedTemporary::NamedTemporary(const std::string& path)
    : path_(path), target_(finalPlaceOf(path).path) {
  // A name has 255 bytes at most: a long one leaves no room for a suffix.
  const size_t slash = target_.find_last_of('/') + 1;
  const std::string stem =
      target_.size() - slash > 220 ? target_.substr(0, slash) + ".longer" : target_;
  struct stat old;
  replaces_ = ::stat(target_.c_str(), &old) == 0;
  if (replaces_ && ::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0)
    failIo(path_, "write");
  removeAbandoned(stem);
  // It keeps its mode, and never has a wider one, not even until the next line.
  create(stem, replaces_ ? old.st_mode & 0777 : 0666);
  if (!replaces_ || ::fchmod(fd_, old.st_mode & 07777) == 0) return;
  const int why = errno;
  if (!isOpenerThan(old, fd_)) return;
  ::unlink(temporary_.c_str());
  ::close(fd_);
  errno = why;
  failIo(path_, "keep the mode of");
}

NamedTemporary::~NamedTemporary() {
  if (!renamed_) ::unlink(temporary_.c_str());
  if (before_ == Before::kKept) ::unlink(old_.c_str());
  if (fd_ >= 0) ::close(fd_);
}

void NamedTemporary::commit() {
  close();
  rename();
}

void NamedTemporary::sync() {
  if (::fdatasync(fd_) != 0 && errno != EINVAL) failIo(path_, "write");
  synced_ = true;
}

// Closing may tell that writing failed; a second descriptor keeps the lock until the name is there.
// What replaces a file is on the disk before: of a rename without that, a system that stops may
// leave an empty file, and the old one is gone. It takes what the disk takes to write it, which it
// has begun (0.1 s of 100 MB on a fast one); a new file has nothing to lose and does not wait.
void NamedTemporary::close() {
  if (replaces_ && !synced_) sync();
  const int lock = ::dup(fd_), written = fd_;
  fd_ = lock;
  if (::close(written) != 0) failIo(path_, "write");
}

// Gives the old file a second name, of the form of our temporary files: if the process is killed
// now, the next run removes it. A file system without links keeps nothing.
void NamedTemporary::keepOld() {
  old_ = temporary_ + "0000";
  spare_ = temporary_ + ".old";
  ::unlink(old_.c_str());
  if (::link(target_.c_str(), old_.c_str()) == 0)
    before_ = Before::kKept;
  else if (errno == ENOENT)
    before_ = Before::kNone;
}

void NamedTemporary::rename() {
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) failIo(path_, "rename into place");
  renamed_ = true;
}

void NamedTemporary::undo() noexcept {
  if (!renamed_) return;
  if (before_ == Before::kNone) ::unlink(target_.c_str());
  if (before_ != Before::kKept) return;
  before_ = Before::kUnknown;
  if (::rename(old_.c_str(), target_.c_str()) == 0) return;
  left_.swap(old_);
  // By that name the next run would take it for abandoned.
  if (::link(left_.c_str(), spare_.c_str()) != 0) return;
  ::unlink(left_.c_str());
  left_.swap(spare_);
}

}  // namespace tetstream
