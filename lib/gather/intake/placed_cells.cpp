#include "placed_cells.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "status.h"
#include "stored_number.h"

namespace tetstream {

static_assert(kMostTag == INT64_MAX >> 1);

namespace {

// Points whose tags follow each other, and whose ranks do.
struct PointRun {
  int64_t tag = 0, tags = 0, rank = 0;
};

// Rows of which the corners begin at `at`.
struct CornerRows {
  const unsigned char* at;
  size_t row_bytes, own_tag;  // the latter: so many bytes before the corners, 0: there is none
};

// The ranks of points of one run; false, with nothing that is of use, unless all are of it. A tag
// is, if neither the tags before it nor those behind it are negative in number.
template <class Stored, bool kSwapped, bool kTagged>
bool ranksInRun(const CornerRows& in, const PointRun& run, size_t rows, int64_t* out) {
  using Bits = std::make_unsigned_t<Stored>;
  using Four [[gnu::vector_size(4 * sizeof(Bits))]] = Bits;
  using FourRanks [[gnu::vector_size(4 * sizeof(uint64_t))]] = uint64_t;
  const auto tag = static_cast<Bits>(run.tag);
  const auto last = static_cast<Bits>(
      std::min<int64_t>(run.tags - 1, std::numeric_limits<Stored>::max() - run.tag));
  const auto rank = static_cast<uint64_t>(run.rank);
  Four outside = {};
  Bits own_tags = 0;
  const unsigned char* row = in.at;
  const size_t row_bytes = in.row_bytes, own_tag = in.own_tag;
  for (size_t i = 0; i < rows; ++i, row += row_bytes, out += 4) {
    Four before;
    for (size_t k = 0; k < 4; ++k) before[k] = storedNumber<Bits, kSwapped>(row + k * sizeof tag);
    before -= tag;
    outside |= before | (last - before);
    const FourRanks ranks = __builtin_convertvector(before, FourRanks) + rank;
    std::memcpy(out, &ranks, sizeof ranks);
    if constexpr (kTagged) own_tags |= storedNumber<Bits, kSwapped>(row - own_tag);
  }
  if (sizeof tag == 8) own_tags |= own_tags << 1;  // kMostTag has 62 bits
  constexpr Bits sign = Bits{1} << (8 * sizeof(Bits) - 1);
  return ((outside[0] | outside[1] | outside[2] | outside[3] | own_tags) & sign) == 0;
}

using Ranks = bool (*)(const CornerRows&, const PointRun&, size_t, int64_t*);

template <bool kSwapped>
Ranks findRanks(const CornersOfRow& corners) {
  if (corners.width == 4)
    return corners.is_tagged ? ranksInRun<int32_t, kSwapped, true>
                             : ranksInRun<int32_t, kSwapped, false>;
  return corners.is_tagged ? ranksInRun<int64_t, kSwapped, true>
                           : ranksInRun<int64_t, kSwapped, false>;
}

class PlacedCells final : public RowReader {
 public:
  PlacedCells(std::shared_ptr<FileWindow> window, PlacedCellsPlan plan)
      : window_(std::move(window)),
        plan_(std::move(plan)),
        ranks_(plan_.place.swapped ? findRanks<true>(plan_.corners)
                                   : findRanks<false>(plan_.corners)),
        is_one_run_(plan_.points->isOneRun(&run_.tag, &run_.tags, &run_.rank) &&
                    (plan_.corners.width == 8 || run_.tag <= INT32_MAX)) {}

  void read(uint64_t first, size_t count, void* out) override {
    auto* to = static_cast<int64_t*>(out);
    const CornersOfRow& corners = plan_.corners;
    forPlacedRows(
        *window_, plan_.place, first, count, [&](const unsigned char* rows, size_t n, uint64_t at) {
          const CornerRows in = {rows + corners.at_byte, plan_.place.row_bytes, corners.at_byte};
          if (!is_one_run_ || !ranks_(in, run_, n, to)) findEach(rows, n, at, to);
          to += 4 * n;
          return true;
        });
  }

 private:
  int64_t integerAt(const unsigned char* at) const {
    return storedInteger(at, plan_.corners.width, plan_.place.swapped);
  }

  void findEach(const unsigned char* row, size_t rows, uint64_t first, int64_t* out) {
    for (size_t i = 0; i < rows; ++i, row += plan_.place.row_bytes, out += 4) {
      const int64_t tag = plan_.corners.is_tagged ? integerAt(row) : 0;
      if (tag < 0 || tag > kMostTag)
        failRow(first + i, textOf("%lld is no tag", static_cast<long long>(tag)));
      for (size_t k = 0; k < 4; ++k) {
        const int64_t corner = integerAt(row + plan_.corners.at_byte + k * plan_.corners.width);
        if (!plan_.points->find(corner, &out[k])) failRow(first + i, plan_.missing(tag, corner));
      }
    }
  }

  [[noreturn]] void failRow(uint64_t row, const std::string& text) const {
    fail(Status::kBadData, "%s: byte %llu: %s", window_->file().name().c_str(),
         static_cast<unsigned long long>(plan_.place.begin + row * plan_.place.row_bytes),
         text.c_str());
  }

  std::shared_ptr<FileWindow> window_;
  PlacedCellsPlan plan_;
  Ranks ranks_;
  PointRun run_;
  bool is_one_run_;
};

}  // namespace

std::shared_ptr<RowReader> placeCells(std::shared_ptr<FileWindow> window, PlacedCellsPlan plan) {
  return std::make_shared<PlacedCells>(std::move(window), std::move(plan));
}

}  // namespace tetstream
