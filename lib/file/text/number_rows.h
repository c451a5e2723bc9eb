// file/text: rows of numbers of a text, all of one pattern, read from where they lie in memory.
// Depends on piece_parser.h, plain_number.h, text_number.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "piece_parser.h"

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
class RowParser final : public PieceParser {
 public:
  // From `comment` (0: none) to the end of the line is blank.
  RowParser(const RowPattern& pattern, char comment);

  struct Place {
    uint64_t bytes, lines;  // before it
  };
  // From the beginning of a row on; the numbers of whole rows, up to the first row that is none.
  Found parse(const char* text, size_t size, uint64_t* out) const override;
  // The end of the first `count` numbers of what was parsed; of whole rows, with what is passed
  // over if `with_line_end`.
  Place endOf(const char* text, size_t size, size_t count, bool with_line_end) const;
  // A row that the text ends within is written, too.
  size_t roomFor(size_t bytes) const override {
    return bytes / 2 + 1 + pattern_.width() + RowPattern::kMostFurther;
  }

  bool isCutAtBlanks() const override { return pattern_.isOneKind() && comment_ == 0; }

  const RowPattern& pattern() const { return pattern_; }

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
