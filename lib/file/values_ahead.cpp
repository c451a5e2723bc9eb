#include "values_ahead.h"

#include <algorithm>

namespace tetstream {

ValuesAhead::ValuesAhead(const TextThreads& threads, ByteSource& bytes, ValueType type,
                         uint64_t begin, uint64_t end)
    : parser_(type),
      bytes_(bytes),
      text_at_(begin),
      end_(end),
      piece_{0, begin},
      pieces_(new TextPieces(threads, parser_)) {}

// note: that reading failed is said by who reads on from there, and again.
size_t ValuesAhead::readText(char* out, size_t size, bool* fails) {
  const auto wanted = static_cast<size_t>(std::min<uint64_t>(size, end_ - text_at_));
  size_t got = 0;
  try {
    got = bytes_.readAt(text_at_, out, wanted);
  } catch (...) {
    *fails = true;
  }
  text_at_ += got;
  return got;
}

// On to the next piece, if everything of this one was taken.
bool ValuesAhead::next() {
  if (has_piece_) {
    if (!pieces_->found().is_whole) return false;
    piece_.value += held_;
    piece_.place += pieces_->textBytes();
    pieces_->dropFirst();
  }
  has_piece_ = false;
  taken_ = held_ = 0;
  pieces_->fill([this](char* out, size_t size, bool* fails) { return readText(out, size, fails); },
                UINT64_MAX);
  if (!pieces_->waitForFirst()) return false;
  has_piece_ = true;
  held_ = pieces_->found().numbers;
  return held_ > 0;
}

uint64_t ValuesAhead::place() const {
  if (!has_piece_) return piece_.place;
  const char* const begin = pieces_->text();
  const char* const end = begin + pieces_->textBytes();
  if (taken_ == held_ && pieces_->found().is_whole) return piece_.place + pieces_->textBytes();
  const char* at = begin;
  for (size_t i = 0; i < taken_; ++i) {
    at = std::find_if_not(at, end, isBlank);
    at = std::find_if(at, end, isBlank);
  }
  return piece_.place + static_cast<uint64_t>(at - begin);
}

}  // namespace tetstream
