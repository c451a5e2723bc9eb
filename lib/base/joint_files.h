// base: files that get their names together: all of one run's or none. Depends on
// named_temporary.h.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "named_temporary.h"

namespace tetstream {

class JointFiles {
 public:
  // A file that is to be one of them, until it is left or written.
  void enter(const NamedTemporary& file) { begun_.push_back(&file); }
  void leave(const NamedTemporary* file) noexcept { std::erase(begun_, file); }
  // Throws kBadArgument if two of those have the same name.
  void needDistinct() const;

  // A file that is written, but not closed.
  void add(std::unique_ptr<NamedTemporary> file) { files_.push_back(std::move(file)); }

  // A single file is closed and renamed. Of several, all are on the disk before the first one is
  // renamed, and where one cannot be, the names before it are again what they were; what does not
  // get its name back is kept, as the error tells. Throws kIo, and kBadArgument for two of the same
  // name; none has its name then.
  void commit();
  void forget() noexcept { files_.clear(); }

 private:
  void prepare();
  void undo(size_t renamed) noexcept;
  std::string leftInWords() const;

  std::vector<const NamedTemporary*> begun_;  // borrowed
  std::vector<std::unique_ptr<NamedTemporary>> files_;
};

}  // namespace tetstream
