#include "named_temporary.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <memory>

#include "io_error.h"

namespace tetstream {

static bool isLockedBySomebody(int fd) {
  return ::flock(fd, LOCK_EX | LOCK_NB) != 0;  // as is one that cannot be locked at all
}

// ".<process>-<attempt>", hexadecimal.
static bool isSuffix(const char* text) {
  constexpr const char* kDigits = "0123456789abcdef";
  if (*text++ != '.') return false;
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

void NamedTemporary::create(const std::string& stem) {
  // note: not mkstemp, which would not give the file the mode that the user's umask allows.
  for (unsigned attempt = 0; attempt < kAttempts; ++attempt) {
    temporary_ = textOf("%s.%lx-%x", stem.c_str(), static_cast<long>(::getpid()), attempt);
    fd_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
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

// Empty where there is none.
static std::string realPath(const std::string& path) {
  const std::unique_ptr<char, void (*)(void*)> real(::realpath(path.c_str(), nullptr), std::free);
  return real ? real.get() : "";
}

// The file that a name is, or would be, of.
static std::string targetOf(const std::string& path) {
  std::string there = realPath(path);
  if (!there.empty()) return there;
  const size_t slash = path.find_last_of('/') + 1;
  const std::string folder = realPath(slash ? path.substr(0, slash) : ".");
  return folder.empty() ? path : folder + "/" + path.substr(slash);
}

NamedTemporary::NamedTemporary(const std::string& path) : path_(path), target_(targetOf(path)) {
  // A name has 255 bytes at most: a long one leaves no room for a suffix.
  const size_t slash = target_.find_last_of('/') + 1;
  const std::string stem =
      target_.size() - slash > 220 ? target_.substr(0, slash) + ".tetstream" : target_;
  removeAbandoned(stem);
  create(stem);
  struct stat old;  // what is replaced keeps its mode
  if (::stat(target_.c_str(), &old) == 0) ::fchmod(fd_, old.st_mode & 07777);
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
  if (::fsync(fd_) != 0) failIo(path_, "write");
}

// Closing may tell that writing failed; a second descriptor keeps the lock until the name is there.
void NamedTemporary::close() {
  const int lock = ::dup(fd_), written = fd_;
  fd_ = lock;
  if (::close(written) != 0) failIo(path_, "write");
}

// Under a name like those of temporary files, with more digits: were the process killed now, the
// next one would remove it. A file system without links keeps nothing.
void NamedTemporary::keepOld() {
  old_ = temporary_ + "0000";
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
  if (before_ == Before::kKept && ::rename(old_.c_str(), target_.c_str()) == 0)
    before_ = Before::kUnknown;
}

}  // namespace tetstream
