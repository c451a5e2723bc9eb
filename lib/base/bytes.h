// base: where bytes come from and go to: files, file descriptors, memory. Depends on status.h,
// waiting.h.
//
// All calls handle short transfers and EINTR, and throw kIo with the name and the system's word.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "waiting.h"

namespace tetstream {

class JointFiles;

class ByteSource {
 public:
  virtual ~ByteSource() = default;
  // Up to `size` bytes from the current place; 0 only at the end.
  virtual size_t read(void* out, size_t size) = 0;
  // Seekable sources only: reads at `offset` without moving the current place; fewer bytes than
  // asked for only at the end.
  virtual size_t readAt(uint64_t offset, void* out, size_t size) = 0;
  virtual bool seekable() const = 0;
  virtual uint64_t size() const = 0;  // of seekable sources
  // Of a pipe, a terminal, whose reads may wait, for ever, for somebody at the other end; null: of
  // none. Once it is ended they fail.
  virtual std::shared_ptr<Waiting> waiting() const { return nullptr; }
  const std::string& name() const { return name_; }  // for messages

 protected:
  explicit ByteSource(std::string name) : name_(std::move(name)) {}

 private:
  std::string name_;
};

std::unique_ptr<ByteSource> openFile(const std::string& path);
// Does not close `fd`. Starts at its current place; seekable if it is a regular file at place 0.
std::unique_ptr<ByteSource> openDescriptor(int fd, const std::string& name);
// Borrows the memory.
std::unique_ptr<ByteSource> openMemory(const void* data, size_t size, const std::string& name);
// Another reading of a seekable source, from its first byte on; borrows it.
std::unique_ptr<ByteSource> readAgain(ByteSource& source);
// A source whose first bytes were read already, all of it again.
std::unique_ptr<ByteSource> withPrefix(std::vector<unsigned char> prefix,
                                       std::unique_ptr<ByteSource> rest);
// A seekable source with the same bytes: itself, or a copy spooled to an unnamed temporary file.
std::unique_ptr<ByteSource> makeSeekable(std::unique_ptr<ByteSource> source,
                                         const std::string& temp_dir);

class ByteSink {
 public:
  virtual ~ByteSink() = default;  // without commit: what was written is dropped where it can be
  virtual void write(const void* data, size_t size) = 0;  // at the end
  // Seekable sinks only: overwrites bytes written before.
  virtual void writeAt(uint64_t offset, const void* data, size_t size) = 0;
  virtual bool seekable() const = 0;
  // As `waiting` of a source; nobody ends it.
  virtual bool waits() const { return false; }
  // Makes the output complete, under its final name unless that is given to several together.
  // Called once, last.
  virtual void commit() = 0;
  const std::string& name() const { return name_; }

 protected:
  explicit ByteSink(std::string name) : name_(std::move(name)) {}

 private:
  std::string name_;
};

// Writes to a temporary file beside `path`, which takes that name only at commit. A path that is
// there and is no regular file (a device, a pipe), and a name of one of the process's descriptors
// (/dev/stdout), are written directly, from where they are.
// With `joint`, which is borrowed, the name is taken when all of those are committed.
std::unique_ptr<ByteSink> createFile(const std::string& path, JointFiles* joint = nullptr);
std::unique_ptr<ByteSink> createDescriptor(int fd, const std::string& name);  // does not close it
std::unique_ptr<ByteSink> createMemory(std::vector<unsigned char>& out);      // borrows `out`

// An unnamed temporary file for spooling, gone with the object whatever happens. temp_dir empty:
// $TMPDIR or /tmp.
class SpoolFile {
 public:
  explicit SpoolFile(const std::string& temp_dir);
  ~SpoolFile();
  SpoolFile(const SpoolFile&) = delete;
  SpoolFile& operator=(const SpoolFile&) = delete;
  void append(const void* data, size_t size);
  void writeAt(uint64_t offset, const void* data, size_t size);  // a gap before it reads as zeros
  void readAt(uint64_t offset, void* out, size_t size);  // throws when there are fewer bytes
  uint64_t size() const { return size_; }
  int descriptor() const { return fd_; }
  const std::string& name() const { return name_; }  // for messages

 private:
  int fd_ = -1;
  uint64_t size_ = 0;
  std::string name_;
};

// Buffers small writes; flush before the sink is used directly.
class BufferedSink {
 public:
  explicit BufferedSink(ByteSink& sink, size_t capacity = 1 << 16);
  void write(const void* data, size_t size);
  void flush();
  uint64_t written() const { return flushed_ + buffer_.size(); }

 private:
  ByteSink& sink_;
  std::vector<unsigned char> buffer_;
  uint64_t flushed_ = 0;
};

}  // namespace tetstream
