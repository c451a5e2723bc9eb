// base: a file that is written beside its final name, and gets that name when it is complete.
// Depends on status.h.
#pragma once

#include <string>

namespace tetstream {

// Within one file system the rename is atomic. The file is locked while it is written: what a
// process that was killed has left beside the same name has no lock, and is removed by the next.
class NamedTemporary {
 public:
  // Throws kIo. A link stays one: what it points to is replaced.
  explicit NamedTemporary(const std::string& path);
  ~NamedTemporary();  // without commit, nothing is left
  NamedTemporary(const NamedTemporary&) = delete;
  NamedTemporary& operator=(const NamedTemporary&) = delete;

  int descriptor() const { return fd_; }
  void commit();

 private:
  void create(const std::string& stem);

  std::string path_, target_, temporary_;
  int fd_ = -1;
  bool committed_ = false;
};

}  // namespace tetstream
