#include "interleaved_cells.h"

#include <algorithm>
#include <vector>

#include "rows_at_once.h"
#include "status.h"

namespace tetstream {

namespace {

constexpr size_t kRow = 5;

class TetrahedronPoints final : public Values {
 public:
  TetrahedronPoints(std::unique_ptr<Values> rows, std::string name, uint64_t first_cell)
      : rows_(std::move(rows)), name_(std::move(name)), first_cell_(first_cell) {}

  // Whole rows only, as columns ask for them.
  void read(uint64_t first, size_t count, void* out, ScalarType) override {
    rows_read_.resize(kRow * kRowsAtOnce);
    int64_t* const rows = rows_read_.data();
    int64_t* to = static_cast<int64_t*>(out);
    uint64_t row = first / 4;
    for (size_t left = count / 4; left > 0;) {
      const size_t n = std::min(left, kRowsAtOnce);
      rows_->read(row * kRow, n * kRow, rows, ScalarType::kInt64);
      for (size_t i = 0; i < n; ++i, to += 4) {
        if (rows[kRow * i] != 4) failRow(row + i, rows[kRow * i]);
        std::copy_n(rows + kRow * i + 1, 4, to);
      }
      row += n;
      left -= n;
    }
  }

 private:
  [[noreturn]] void failRow(uint64_t row, int64_t points) const {
    fail(Status::kBadData, "%s: cell %llu is a tetrahedron with %lld points", name_.c_str(),
         static_cast<unsigned long long>(first_cell_ + row), static_cast<long long>(points));
  }

  std::unique_ptr<Values> rows_;
  std::string name_;
  uint64_t first_cell_;
  std::vector<int64_t> rows_read_;  // kept off the stack, of which callers' threads may have little
};

}  // namespace

void dropCounts(const std::string& name, MeshPiece& piece) {
  if (!piece.connectivity) return;
  if (piece.connectivity_size != kRow * piece.cell_count)
    fail(Status::kBadData, "%s: %llu tetrahedra take %llu numbers, not %llu", name.c_str(),
         static_cast<unsigned long long>(piece.cell_count),
         static_cast<unsigned long long>(kRow * piece.cell_count),
         static_cast<unsigned long long>(piece.connectivity_size));
  auto open = std::move(piece.connectivity->open);
  piece.connectivity->open = [open = std::move(open), name,
                              first = piece.first_cell](uint64_t count) {
    return std::make_unique<TetrahedronPoints>(open(count / 4 * kRow), name, first);
  };
}

}  // namespace tetstream
