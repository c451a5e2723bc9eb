// file: values of a text array that were read ahead, in turn. Depends on text_values.h,
// text_pieces.h.
#pragma once

#include <algorithm>
#include <cstring>

#include "text_pieces.h"
#include "text_values.h"

namespace tetstream {

// The number of a value, and a byte of the file from which on it is found.
struct ValuePlace {
  uint64_t value, place;
};

class ValuesAhead {
 public:
  // From byte `begin` of the text on; borrows `bytes`.
  ValuesAhead(const TextThreads& threads, ByteSource& bytes, ValueType type, uint64_t begin,
              uint64_t end);
  ~ValuesAhead() { pieces_->close(); }
  ValuesAhead(const ValuesAhead&) = delete;
  ValuesAhead& operator=(const ValuesAhead&) = delete;

  // The next values, up to `count`, which come from a T. Fewer: the next one must be read from the
  // text, or is none, or none that Out can hold.
  template <class T, class Out>
  size_t take(size_t count, Out* out) {
    size_t done = 0;
    while (done < count && (taken_ < held_ || next())) {
      const size_t wanted = std::min(count - done, held_ - taken_);
      const size_t n = takeHeld<T>(wanted, out + done);
      done += n;
      if (n < wanted) break;
    }
    return done;
  }

  // The byte of the file behind what was taken.
  uint64_t place() const;
  // Where the piece begins that was last taken from, and with which value.
  const ValuePlace& piece() const { return piece_; }

 private:
  bool next();
  size_t readText(char* out, size_t size, bool* fails);

  template <class T, class Out>
  size_t takeHeld(size_t count, Out* out) {
    const auto* from = reinterpret_cast<const unsigned char*>(pieces_->numbers());
    for (size_t i = 0; i < count; ++i, ++taken_) {
      T value;
      std::memcpy(&value, from + taken_ * sizeof(T), sizeof value);
      if (!holds<Out>(value)) return i;
      out[i] = static_cast<Out>(value);
    }
    return count;
  }

  const ValueParser parser_;
  ByteSource& bytes_;
  uint64_t text_at_, end_;  // behind what the pieces have; of the text
  ValuePlace piece_;
  Kept<TextPieces> pieces_;
  bool has_piece_ = false;
  size_t taken_ = 0, held_ = 0;  // values of the first piece
};

}  // namespace tetstream
