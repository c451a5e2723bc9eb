// file/text: what reads the numbers of a piece of a text. Depends on nothing.
#pragma once

#include <cstddef>
#include <cstdint>

namespace tetstream {

class PieceParser {
 public:
  struct Found {
    size_t numbers = 0;
    bool is_whole = false;  // nothing is left behind them
    uint64_t lines = 0;     // that end in what was looked at
  };

  PieceParser() = default;
  PieceParser(const PieceParser&) = default;
  virtual ~PieceParser() = default;
  // `size` bytes of text, behind which kPlainNumberBytes zeros stand; up to the first thing that
  // should not be there.
  virtual Found parse(const char* text, size_t size, uint64_t* out) const = 0;
  // Room for what parse may write of so many bytes.
  virtual size_t roomFor(size_t bytes) const = 0;
  // Whether a piece may end at any blank; else at the end of a line.
  virtual bool isCutAtBlanks() const = 0;
};

}  // namespace tetstream
