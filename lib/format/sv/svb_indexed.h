// format/sv: .svb files that are no streams: all vertices, then all cells, nothing finalized.
// Elements have fixed places, so they are read where they stand. Depends on sv_open.h.
#pragma once

#include <memory>

#include "sv_open.h"

namespace tetstream {

class SvbScanner final : public SvScanner {
 public:
  explicit SvbScanner(bool swapped) : swapped_(swapped) {}
  SvForm feed(const unsigned char* data, size_t size) override;
  SvForm end() override;
  int64_t vertexCount() const { return vertices_; }
  int64_t cellCount() const { return cells_; }

 private:
  SvForm takeWord(uint32_t word);

  bool swapped_;
  size_t word_ = 0;  // number of the next word in its block, 0: the descriptor
  uint32_t descriptor_ = 0;
  int64_t vertices_ = 0, cells_ = 0;
  unsigned char part_[4] = {};  // of a word that the last feed cut
  size_t part_size_ = 0;
};

// `body` is the place of the first block, counts are in the schema; the bytes are seekable.
std::unique_ptr<IndexedSource> openSvbIndexed(SvBytes bytes, uint64_t body, bool swapped,
                                              const Schema& schema);

}  // namespace tetstream
