// measure/search: work on many rows, some of them at the same time. Depends on tasks.h.
#pragma once

#include <algorithm>
#include <cstddef>

#include "tasks.h"

namespace tetstream {

constexpr size_t kPiecesAtOnce = 32;

// work(piece, begin, end) for pieces of `each` rows, so many at the same time, with pieces numbered
// from 0; then(pieces) when these are done. Where a piece begins does not depend on the threads:
// what is added up piece by piece is the same for any number of them.
template <class Work, class Then>
void inPieces(const Tasks* tasks, size_t count, size_t each, Work work, Then then) {
  for (size_t first = 0; first < count; first += kPiecesAtOnce * each) {
    const size_t end = std::min(count, first + kPiecesAtOnce * each);
    const size_t pieces = (end - first + each - 1) / each;
    doEach(tasks, pieces, [&](size_t p) {
      const size_t begin = first + p * each;
      work(p, begin, std::min(end, begin + each));
    });
    then(pieces);
  }
}

}  // namespace tetstream
