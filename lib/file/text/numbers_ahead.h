// file/text: numbers of a text that were read ahead, in turn. Depends on number_rows.h,
// text_pieces.h.
#pragma once

#include <cstring>

#include "number_rows.h"
#include "text_pieces.h"

namespace tetstream {

class NumbersAhead {
 public:
  // No more than `rows` are given.
  NumbersAhead(const TextThreads& threads, const RowParser& parser, uint64_t rows,
               TextPieces::Read read);
  ~NumbersAhead() { pieces_->close(); }

  // The next numbers, up to `count`, which must be of their kind. 0: those that follow must be read
  // from the text that is left, or are none of the rows.
  template <class Number>
  size_t take(Number* out, size_t count) {
    static_assert(sizeof(Number) == sizeof(uint64_t));
    if (taken_ == held_ && !next()) return 0;
    const size_t n = count < held_ - taken_ ? count : held_ - taken_;
    std::memcpy(out, takeHere(n), n * sizeof(Number));
    return n;
  }
  // The next `count` where they lie, until the next call; null, with nothing taken, if they are not
  // all there.
  const uint64_t* takeHere(size_t count) {
    if (held_ - taken_ < count) return nullptr;
    const uint64_t* const numbers = pieces_->numbers() + taken_;
    taken_ += count;
    line_is_passed_ = false;
    return numbers;
  }
  // The rest of the line of a row of which everything was taken.
  void passLine();

  // Where the next number is looked for, counted from the beginning.
  RowParser::Place place() const;
  std::vector<char> textLeft() { return pieces_->textFrom(endOfTaken().bytes); }

 private:
  bool next();
  RowParser::Place endOfTaken() const;
  uint64_t bytesWanted() const;

  const RowParser parser_;
  const TextPieces::Read read_;
  Kept<TextPieces> pieces_;
  bool has_piece_ = false, line_is_passed_ = false;
  size_t taken_ = 0, held_ = 0;        // numbers of the piece
  uint64_t rows_left_, numbers_left_;  // of those that may be given; numbers behind the piece
  uint64_t numbers_before_ = 0;        // of pieces that were dropped, as the place
  RowParser::Place before_ = {0, 0};
};

}  // namespace tetstream
