// format/vtk: words, lines and runs of numbers of a legacy VTK file, in order. Depends on bytes.h.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bytes.h"

namespace tetstream {

// Memory is one buffer, whatever the file holds.
class VtkScan {
 public:
  explicit VtkScan(ByteSource& bytes);

  uint64_t place() const { return begin_ + at_; }
  // The next word; empty at the end of the file, or, with `same_line`, of the line.
  std::string word(bool same_line = false);
  std::string line();  // what is left of it, without its end, cut to some hundreds of characters
  bool atEnd() { return !fill(); }
  void seek(uint64_t place);
  // Passes `count` words between blanks; false if there are fewer.
  bool skipWords(uint64_t count);
  // Throws kBadData with the place.
  [[noreturn]] void fail(uint64_t place, const std::string& text) const;

 private:
  bool fill();  // false at the end: afterwards there is a character at at_

  ByteSource& bytes_;
  std::vector<char> text_;
  uint64_t begin_ = 0;  // place of text_[0]
  size_t at_ = 0, filled_ = 0;
};

}  // namespace tetstream
