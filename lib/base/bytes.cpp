#include "bytes.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "final_place.h"
#include "io_error.h"
#include "joint_files.h"
#include "write_signals.h"

namespace tetstream {

// A pipe of Linux holds 64 KB, half a thousandth of a second of work: both ends would wait for each
// other most of the time. So much may be asked for without privileges; where it is refused the pipe
// stays as it is.
static void widenPipe(int fd, const struct stat& info) {
#ifdef F_SETPIPE_SZ
  constexpr int kPipeBytes = 1 << 20;
  if (S_ISFIFO(info.st_mode) && ::fcntl(fd, F_GETPIPE_SZ) < kPipeBytes)
    ::fcntl(fd, F_SETPIPE_SZ, kPipeBytes);
#else
  (void)fd, (void)info;
#endif
}

// Refuses a descriptor that is closed, or open for what it is not wanted for (O_RDONLY, O_WRONLY):
// a long run would come to that at its end.
static void needOpen(int fd, int unwanted, const std::string& name, const char* what) {
  const int flags = ::fcntl(fd, F_GETFL);
  if (flags >= 0 && (flags & O_ACCMODE) == unwanted) errno = EBADF;
  if (flags < 0 || (flags & O_ACCMODE) == unwanted) failIo(name, what);
}

// `waiting` may be null.
static size_t readSome(int fd, void* out, size_t size, const Waiting* waiting,
                       const std::string& name) {
  for (;;) {
    if (waiting && !waiting->forBytes(fd))
      fail(Status::kCancelled, "%s: nobody waits for it any more", name.c_str());
    const ssize_t got = ::read(fd, out, size);
    if (got >= 0) return static_cast<size_t>(got);
    const bool is_shared = waiting && errno == EAGAIN;  // others were there before
    if (errno != EINTR && !is_shared) failIo(name, "read");
  }
}

static size_t readFully(int fd, uint64_t offset, void* out, size_t size, const std::string& name) {
  size_t done = 0;
  while (done < size) {
    const ssize_t got =
        ::pread(fd, static_cast<char*>(out) + done, size - done, static_cast<off_t>(offset + done));
    if (got == 0) break;
    if (got < 0 && errno != EINTR) failIo(name, "read");
    if (got > 0) done += static_cast<size_t>(got);
  }
  return done;
}

// Somebody may have made a pipe or a terminal one that does not wait.
static bool waitsForRoom(int fd) {
  if (errno != EAGAIN) return false;
  struct pollfd room = {fd, POLLOUT, 0};
  return ::poll(&room, 1, -1) >= 0 || errno == EINTR;
}

static void writeFully(int fd, const void* data, size_t size, const std::string& name) {
  const WriteSignalsHeld held;
  size_t done = 0;
  while (done < size) {
    const ssize_t put = ::write(fd, static_cast<const char*>(data) + done, size - done);
    if (put < 0 && errno != EINTR && !waitsForRoom(fd)) failIo(name, "write");
    if (put > 0) done += static_cast<size_t>(put);
  }
}

static void writeFullyAt(int fd, uint64_t offset, const void* data, size_t size,
                         const std::string& name) {
  const WriteSignalsHeld held;
  size_t done = 0;
  while (done < size) {
    const ssize_t put = ::pwrite(fd, static_cast<const char*>(data) + done, size - done,
                                 static_cast<off_t>(offset + done));
    if (put < 0 && errno != EINTR) failIo(name, "write");
    if (put > 0) done += static_cast<size_t>(put);
  }
}

// ---------------------------------------------------------------------------------- sources

namespace {

class DescriptorSource final : public ByteSource {
 public:
  DescriptorSource(int fd, bool owned, std::string name)
      : ByteSource(std::move(name)), fd_(fd), owned_(owned) {
    struct stat info;
    if (::fstat(fd, &info) != 0) {
      const int error = errno;
      if (owned) ::close(fd);
      errno = error;
      failIo(this->name(), "open");
    }
    widenPipe(fd, info);
    const bool is_file = S_ISREG(info.st_mode);
    if (!is_file) waiting_ = std::make_shared<Waiting>();
    seekable_ = is_file && ::lseek(fd, 0, SEEK_CUR) == 0;
    size_ = seekable_ ? static_cast<uint64_t>(info.st_size) : 0;
  }
  ~DescriptorSource() override {
    if (owned_) ::close(fd_);
  }
  size_t read(void* out, size_t size) override {
    return readSome(fd_, out, size, waiting_.get(), name());
  }
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    return readFully(fd_, offset, out, size, name());
  }
  bool seekable() const override { return seekable_; }
  uint64_t size() const override { return size_; }
  std::shared_ptr<Waiting> waiting() const override { return waiting_; }

 private:
  int fd_;
  bool owned_, seekable_;
  uint64_t size_;
  std::shared_ptr<Waiting> waiting_;
};

class MemorySource final : public ByteSource {
 public:
  MemorySource(const void* data, size_t size, const std::string& name)
      : ByteSource(name), data_(static_cast<const char*>(data)), size_(size) {}
  size_t read(void* out, size_t size) override {
    const size_t got = readAt(place_, out, size);
    place_ += got;
    return got;
  }
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    if (offset >= size_) return 0;
    const size_t got = size < size_ - offset ? size : static_cast<size_t>(size_ - offset);
    if (got) std::memcpy(out, data_ + offset, got);
    return got;
  }
  bool seekable() const override { return true; }
  uint64_t size() const override { return size_; }

 private:
  const char* data_;
  uint64_t size_, place_ = 0;
};

class SecondReading final : public ByteSource {
 public:
  explicit SecondReading(ByteSource& source) : ByteSource(source.name()), source_(source) {}
  size_t read(void* out, size_t size) override {
    const size_t got = source_.readAt(place_, out, size);
    place_ += got;
    return got;
  }
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    return source_.readAt(offset, out, size);
  }
  bool seekable() const override { return true; }
  uint64_t size() const override { return source_.size(); }
  std::shared_ptr<Waiting> waiting() const override { return source_.waiting(); }

 private:
  ByteSource& source_;
  uint64_t place_ = 0;
};

// A source whose first bytes have been read already.
class PrefixedSource final : public ByteSource {
 public:
  PrefixedSource(std::vector<unsigned char> prefix, std::unique_ptr<ByteSource> rest)
      : ByteSource(rest->name()), prefix_(std::move(prefix)), rest_(std::move(rest)) {}
  size_t read(void* out, size_t size) override {
    if (place_ == prefix_.size()) return rest_->read(out, size);
    const size_t got = size < prefix_.size() - place_ ? size : prefix_.size() - place_;
    if (got) std::memcpy(out, prefix_.data() + place_, got);
    place_ += got;
    return got;
  }
  size_t readAt(uint64_t, void*, size_t) override { return 0; }
  bool seekable() const override { return false; }
  uint64_t size() const override { return 0; }
  std::shared_ptr<Waiting> waiting() const override { return rest_->waiting(); }

 private:
  std::vector<unsigned char> prefix_;
  size_t place_ = 0;
  std::unique_ptr<ByteSource> rest_;
};

class SpooledSource final : public ByteSource {
 public:
  SpooledSource(ByteSource& from, const std::string& temp_dir)
      : ByteSource(from.name()), spool_(temp_dir) {
    std::vector<unsigned char> block(1 << 16);
    while (const size_t got = from.read(block.data(), block.size()))
      spool_.append(block.data(), got);
  }
  size_t read(void* out, size_t size) override {
    const size_t got = readAt(place_, out, size);
    place_ += got;
    return got;
  }
  size_t readAt(uint64_t offset, void* out, size_t size) override {
    return readFully(spool_.descriptor(), offset, out, size, name());
  }
  bool seekable() const override { return true; }
  uint64_t size() const override { return spool_.size(); }

 private:
  SpoolFile spool_;
  uint64_t place_ = 0;
};

}  // namespace

std::unique_ptr<ByteSource> openFile(const std::string& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) failIo(path, "open");
  return std::make_unique<DescriptorSource>(fd, true, path);
}

std::unique_ptr<ByteSource> openDescriptor(int fd, const std::string& name) {
  needOpen(fd, O_WRONLY, name, "read");
  return std::make_unique<DescriptorSource>(fd, false, name);
}

std::unique_ptr<ByteSource> openMemory(const void* data, size_t size, const std::string& name) {
  return std::make_unique<MemorySource>(data, size, name);
}

std::unique_ptr<ByteSource> readAgain(ByteSource& source) {
  return std::make_unique<SecondReading>(source);
}

std::unique_ptr<ByteSource> withPrefix(std::vector<unsigned char> prefix,
                                       std::unique_ptr<ByteSource> rest) {
  return std::make_unique<PrefixedSource>(std::move(prefix), std::move(rest));
}

std::unique_ptr<ByteSource> makeSeekable(std::unique_ptr<ByteSource> source,
                                         const std::string& temp_dir) {
  if (source->seekable()) return source;
  return std::make_unique<SpooledSource>(*source, temp_dir);
}

// ------------------------------------------------------------------------------------ sinks

namespace {

class DescriptorSink final : public ByteSink {
 public:
  DescriptorSink(int fd, bool owned, const std::string& name)
      : ByteSink(name), fd_(fd), owned_(owned) {
    struct stat info;
    const bool is_known = ::fstat(fd, &info) == 0;
    if (is_known) widenPipe(fd, info);
    waits_ = !is_known || !S_ISREG(info.st_mode);
    seekable_ = !waits_ && info.st_size == 0 && ::lseek(fd, 0, SEEK_CUR) == 0 &&
                !(::fcntl(fd, F_GETFL) & O_APPEND);
  }
  ~DescriptorSink() override {
    if (owned_) ::close(fd_);
  }
  void write(const void* data, size_t size) override { writeFully(fd_, data, size, name()); }
  void writeAt(uint64_t offset, const void* data, size_t size) override {
    writeFullyAt(fd_, offset, data, size, name());
  }
  bool seekable() const override { return seekable_; }
  bool waits() const override { return waits_; }
  void commit() override {}

 private:
  int fd_;
  bool owned_, waits_, seekable_;
};

class NamedSink final : public ByteSink {
 public:
  NamedSink(const std::string& path, JointFiles* joint)
      : ByteSink(path), file_(std::make_unique<NamedTemporary>(path)), joint_(joint) {
    if (joint_) joint_->enter(*file_);
  }
  ~NamedSink() override {
    if (joint_) joint_->leave(file_.get());
  }
  void write(const void* data, size_t size) override {
    writeFully(file_->descriptor(), data, size, name());
  }
  void writeAt(uint64_t offset, const void* data, size_t size) override {
    writeFullyAt(file_->descriptor(), offset, data, size, name());
  }
  bool seekable() const override { return true; }
  void commit() override {
    if (!joint_) return file_->commit();
    joint_->leave(file_.get());
    joint_->add(std::move(file_));
  }

 private:
  std::unique_ptr<NamedTemporary> file_;  // with others, until it is committed
  JointFiles* joint_;
};

class MemorySink final : public ByteSink {
 public:
  explicit MemorySink(std::vector<unsigned char>& out) : ByteSink("memory"), out_(out) {
    out_.clear();
  }
  void write(const void* data, size_t size) override {
    const unsigned char* bytes = static_cast<const unsigned char*>(data);
    out_.insert(out_.end(), bytes, bytes + size);
  }
  void writeAt(uint64_t offset, const void* data, size_t size) override {
    if (offset > out_.size() || size > out_.size() - offset)
      fail(Status::kInternal, "memory: bytes to be overwritten were never written");
    if (size) std::memcpy(out_.data() + offset, data, size);
  }
  bool seekable() const override { return true; }
  void commit() override {}

 private:
  std::vector<unsigned char>& out_;
};

}  // namespace

std::unique_ptr<ByteSink> createFile(const std::string& path, JointFiles* joint) {
  if (const int own = finalPlaceOf(path).descriptor; own >= 0) {
    needOpen(own, O_RDONLY, path, "write");
    const int fd = ::fcntl(own, F_DUPFD_CLOEXEC, 0);
    if (fd < 0) failIo(path, "open");
    return std::make_unique<DescriptorSink>(fd, true, path);
  }
  struct stat info;
  if (::stat(path.c_str(), &info) == 0 && !S_ISREG(info.st_mode)) {
    const int fd = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (fd < 0) failIo(path, "open");
    return std::make_unique<DescriptorSink>(fd, true, path);
  }
  return std::make_unique<NamedSink>(path, joint);
}

std::unique_ptr<ByteSink> createDescriptor(int fd, const std::string& name) {
  needOpen(fd, O_RDONLY, name, "write");
  return std::make_unique<DescriptorSink>(fd, false, name);
}

std::unique_ptr<ByteSink> createMemory(std::vector<unsigned char>& out) {
  return std::make_unique<MemorySink>(out);
}

// ------------------------------------------------------------------------------------ spool

SpoolFile::SpoolFile(const std::string& temp_dir) {
  std::string dir = temp_dir;
  if (dir.empty()) {
    const char* set = std::getenv("TMPDIR");
    dir = set && *set ? set : "/tmp";
  }
  // Never with a name, so that not even a kill leaves one; where the file system has no such files,
  // with one for a moment.
#ifdef O_TMPFILE
  name_ = dir + "/(a temporary file)";
  fd_ = ::open(dir.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (fd_ >= 0) return;
#endif
  name_ = dir + "/tetstream.XXXXXX";
  fd_ = ::mkostemp(name_.data(), O_CLOEXEC);
  if (fd_ < 0) failIo(name_, "create a temporary file");
  ::unlink(name_.c_str());
}

SpoolFile::~SpoolFile() {
  ::close(fd_);
}

void SpoolFile::append(const void* data, size_t size) {
  writeFully(fd_, data, size, name_);
  size_ += size;
}

void SpoolFile::writeAt(uint64_t offset, const void* data, size_t size) {
  writeFullyAt(fd_, offset, data, size, name_);
  size_ = std::max(size_, offset + size);
}

void SpoolFile::readAt(uint64_t offset, void* out, size_t size) {
  if (readFully(fd_, offset, out, size, name_) != size)
    fail(Status::kIo, "%s: the temporary file is shorter than what was written", name_.c_str());
}

BufferedSink::BufferedSink(ByteSink& sink, size_t capacity) : sink_(sink) {
  buffer_.reserve(capacity);
}

void BufferedSink::write(const void* data, size_t size) {
  if (size > buffer_.capacity() - buffer_.size()) flush();
  if (size >= buffer_.capacity()) {
    sink_.write(data, size);
    flushed_ += size;
    return;
  }
  const unsigned char* bytes = static_cast<const unsigned char*>(data);
  buffer_.insert(buffer_.end(), bytes, bytes + size);
}

void BufferedSink::flush() {
  if (buffer_.empty()) return;
  sink_.write(buffer_.data(), buffer_.size());
  flushed_ += buffer_.size();
  buffer_.clear();
}

}  // namespace tetstream
