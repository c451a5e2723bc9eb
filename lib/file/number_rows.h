// file: rows of numbers of a text, all of one pattern, read from where they lie in memory. Depends
// on plain_number.h, text_number.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tetstream {

// The longest word of a text.
constexpr size_t kMostWordBytes = 1024;

struct NumberRun {
  bool is_real;  // else they are integers
  size_t count;
};

// What a row is made of. Where its numbers are all of one kind and to_line_end is false, rows say
// nothing: it is a text of numbers.
struct RowPattern {
  std::vector<NumberRun> runs;
  // Of rows that are one integer: how many there are behind it, at most kMostFurther; more: the row
  // is none.
  size_t (*further)(int64_t first) = nullptr;
  bool to_line_end = false;  // what stands behind a row in its line is passed over

  static constexpr size_t kMostFurther = 64;
  size_t width() const;  // numbers of a row, without further ones
  bool isOneKind() const { return runs.size() == 1 && !further && !to_line_end; }
};

// Numbers are kept as eight bytes each, those of an int64_t or of a double.
class RowParser {
 public:
  // From `comment` (0: none) to the end of the line is blank.
  RowParser(const RowPattern& pattern, char comment);

  struct Found {
    size_t numbers = 0;     // of whole rows
    bool is_whole = false;  // nothing is left behind them
    uint64_t lines = 0;     // that end in what was looked at
  };
  struct Place {
    uint64_t bytes, lines;  // before it
  };
  // `size` bytes of text, from the beginning of a row on, behind which kPlainNumberBytes zeros
  // stand; up to the first row that is none.
  Found parse(const char* text, size_t size, uint64_t* out) const;
  // The end of the first `count` numbers of what was parsed; of whole rows, with what is passed
  // over if `with_line_end`.
  Place endOf(const char* text, size_t size, size_t count, bool with_line_end) const;
  // Room for what parse may write of so many bytes: a row that they end within is written, too.
  size_t roomFor(size_t bytes) const {
    return bytes / 2 + 1 + pattern_.width() + RowPattern::kMostFurther;
  }

  const RowPattern& pattern() const { return pattern_; }
  bool hasComments() const { return comment_ != 0; }

 private:
  struct Text {
    const char *at, *end;
    uint64_t lines = 0;  // ends before `at`
  };
  bool passBlanks(Text& text) const;
  void passLine(Text& text) const;
  template <class Number>
  size_t readNumbers(Text& text, uint64_t* out, size_t count) const;
  size_t readRun(const NumberRun& run, Text& text, uint64_t* out, size_t count) const;
  size_t readRow(Text& text, uint64_t* out, size_t most) const;

  RowPattern pattern_;
  char comment_;
};

}  // namespace tetstream
