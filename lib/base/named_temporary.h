// base: a file that is written beside its final name, and gets that name when it is complete.
// Depends on status.h.
#pragma once

#include <string>

namespace tetstream {

// Within one file system the rename is atomic. The file is locked while it is written: what a
// process that was killed has left beside the same name has no lock, and is removed by the next.
class NamedTemporary {
 public:
  // Throws kIo, also where what is there may not be written. A link stays one: what it leads to is
  // replaced, or made.
  explicit NamedTemporary(const std::string& path);
  ~NamedTemporary();  // without commit, nothing is left
  NamedTemporary(const NamedTemporary&) = delete;
  NamedTemporary& operator=(const NamedTemporary&) = delete;

  int descriptor() const { return fd_; }
  void commit();

  // The steps of it, for files that get their names together (joint_files.h): each throws kIo.
  void sync();     // to the disk
  void close();    // nothing is written any more; synced if it replaces a file
  void keepOld();  // what has the name now stays beside, as long as this does
  void rename();
  // The name is as it was before the rename. Where that cannot be, what had it stays beside, as
  // left() then tells.
  void undo() noexcept;
  const std::string& left() const { return left_; }
  const std::string& target() const { return target_; }
  const std::string& path() const { return path_; }

 private:
  void create(const std::string& stem, unsigned mode);
  enum class Before { kUnknown, kNone, kKept };

  std::string path_, target_, temporary_, old_, spare_, left_;
  int fd_ = -1;
  Before before_ = Before::kUnknown;  // what the name was of
  bool replaces_ = false, synced_ = false, renamed_ = false;
};

}  // namespace tetstream
