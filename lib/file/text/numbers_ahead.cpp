#include "numbers_ahead.h"

#include <algorithm>

namespace tetstream {

namespace {

constexpr uint64_t kLeastBytes = 2;  // of a number, with a blank

uint64_t numbersOf(const RowPattern& pattern, uint64_t rows) {
  const uint64_t width = pattern.width();
  return pattern.further || rows > UINT64_MAX / width ? UINT64_MAX : rows * width;
}

}  // namespace

NumbersAhead::NumbersAhead(const TextThreads& threads, const RowParser& parser, uint64_t rows,
                           TextPieces::Read read)
    : parser_(parser),
      read_(std::move(read)),
      pieces_(new TextPieces(threads, parser_)),
      rows_left_(rows),
      numbers_left_(numbersOf(parser.pattern(), rows)) {}

// On to the next piece, if everything of this one was read.
bool NumbersAhead::next() {
  if (numbers_left_ == 0) return false;
  if (has_piece_) {
    if (!pieces_->found().is_whole) return false;
    numbers_before_ += pieces_->found().numbers;
    before_.bytes += pieces_->textBytes();
    before_.lines += pieces_->found().lines;
    pieces_->dropFirst();
  }
  has_piece_ = line_is_passed_ = false;
  taken_ = held_ = 0;
  pieces_->fill(read_, bytesWanted());
  if (!pieces_->waitForFirst()) return false;
  has_piece_ = true;
  held_ = static_cast<size_t>(std::min<uint64_t>(pieces_->found().numbers, numbers_left_));
  if (numbers_left_ < UINT64_MAX) numbers_left_ -= held_;
  return held_ > 0;
}

// As many as those before had for their numbers.
uint64_t NumbersAhead::bytesWanted() const {
  const uint64_t each = numbers_before_ > 0 ? before_.bytes / numbers_before_ + 1 : kLeastBytes;
  return numbers_left_ > UINT64_MAX / each ? UINT64_MAX : numbers_left_ * each;
}

void NumbersAhead::passLine() {
  line_is_passed_ = true;
  if (--rows_left_ > 0) return;
  held_ = taken_;
  numbers_left_ = 0;
}

RowParser::Place NumbersAhead::endOfTaken() const {
  if (!has_piece_) return {0, 0};
  return parser_.endOf(pieces_->text(), pieces_->textBytes(), taken_, line_is_passed_);
}

RowParser::Place NumbersAhead::place() const {
  const RowParser::Place end = endOfTaken();
  return {before_.bytes + end.bytes, before_.lines + end.lines};
}

}  // namespace tetstream
