#include "sample_stretch.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace tetstream {

static void copyBytes(const void* from, size_t row, size_t bytes, void* to) {
  std::memcpy(to, static_cast<const char*>(from) + row * bytes, bytes);
}

SampleStretch::SampleStretch(const Schema& schema, const Bricks& bricks, uint64_t reach,
                             uint64_t most, const Stretch::Begin& begin)
    : schema_(schema),
      bricks_(bricks),
      reach_(reach),
      most_(most),
      begin_(begin),
      sample_(schema),
      row_of_(std::bit_ceil(reach), kNone),
      met_(bricks.size()),
      next_cell_(begin.first_cell) {}

size_t SampleStretch::copyVertex(const BatchView& from, size_t row, uint64_t rank, uint32_t brick) {
  const size_t to = sample_.addVertices(1);
  copyBytes(from.positions, row, 3 * sizeOf(schema_.position_type), sample_.position(to));
  for (size_t f = 0; f < schema_.fields.size(); ++f)
    copyBytes(from.fields[f], row, schema_.fields[f].bytesPerRow(), sample_.field(f, to));
  rank_of_.push_back(rank);
  brick_of_.push_back(brick);
  used_.push_back(false);
  cut_.push_back(false);
  held_.push_back(false);
  return to;
}

void SampleStretch::copyCell(const BatchView& from, size_t row, const uint32_t rows[4],
                             uint64_t part) {
  const size_t to = sample_.addCells(1);
  std::copy_n(rows, 4, sample_.cell(to));
  for (size_t d = 0; d < schema_.cell_data.size(); ++d)
    copyBytes(from.cell_data[d], row, schema_.cell_data[d].bytesPerRow(), sample_.cellData(d, to));
  part_of_.push_back(static_cast<uint8_t>(part));
}

void SampleStretch::addVertex(const BatchView& batch, size_t row) {
  double place[3];
  placeAt(batch.positions, schema_.position_type, row, place);
  const uint32_t brick = bricks_.at(place);
  const uint64_t rank = batch.first_vertex + row;
  uint32_t& row_of = row_of_[rank & (row_of_.size() - 1)];
  row_of = kNone;
  if (brick == kNone || ++met_[brick] > most_) return;
  const size_t to = copyVertex(batch, row, rank, brick);
  row_of = static_cast<uint32_t>(to);
  held_[to] = batch.locked && batch.locked[row];
}

// A span larger than announced gives fewer samples, not wrong ones.
uint32_t SampleStretch::rowOf(int64_t vertex) const {
  const auto rank = static_cast<uint64_t>(vertex);
  const uint32_t row = tableRow(vertex);
  return row != kNone && rank_of_[row] == rank && rank + reach_ >= declared_ ? row : kNone;
}

// A cell with vertices of the sample is in it if all are of one brick; if not, they are on its cut.
void SampleStretch::addCell(const BatchView& batch, size_t row_in_batch) {
  const int64_t* corners = batch.cells + 4 * row_in_batch;
  const uint64_t number = next_cell_++;
  if (number < begin_.cell) return;
  uint32_t rows[4], none = kNone;
  for (int j = 0; j < 4; ++j) none &= tableRow(corners[j]);
  if (none == kNone) return;  // most cells
  bool whole = true;
  for (int j = 0; j < 4; ++j) rows[j] = rowOf(corners[j]);
  for (int j = 0; j < 4; ++j)
    whole = whole && rows[j] != kNone && brick_of_[rows[j]] == brick_of_[rows[0]];
  for (uint32_t row : rows)
    if (row != kNone) (whole ? used_ : cut_)[row] = true;
  if (!whole) return;
  const uint64_t part = number * kStreamParts / static_cast<uint64_t>(schema_.cell_count);
  copyCell(batch, row_in_batch, rows, std::min<uint64_t>(part, kStreamParts - 1));
}

void SampleStretch::put(const BatchView& batch) {
  declared_ = batch.first_vertex + batch.vertex_count;
  for (size_t row = 0; row < batch.vertex_count; ++row) addVertex(batch, row);
  for (size_t row = 0; row < batch.cell_count; ++row) addCell(batch, row);
}

// The rows that its rows become; kNone for those that are none here.
std::vector<uint32_t> SampleStretch::appendVertices(const SampleStretch& next,
                                                    const BatchView& from) {
  std::vector<uint32_t> becomes(from.vertex_count, kNone);
  for (size_t row = 0; row < from.vertex_count; ++row) {
    const uint64_t rank = next.rank_of_[row];
    const uint32_t brick = next.brick_of_[row];
    if (rank < next.begin_.vertex) {
      const auto known = std::lower_bound(rank_of_.begin(), rank_of_.end(), rank);
      if (known == rank_of_.end() || *known != rank) continue;
      becomes[row] = static_cast<uint32_t>(known - rank_of_.begin());
    } else if (++met_[brick] <= most_) {
      becomes[row] = static_cast<uint32_t>(copyVertex(from, row, rank, brick));
    } else {
      continue;
    }
    if (next.cut_[row]) cut_[becomes[row]] = true;
    if (next.held_[row]) held_[becomes[row]] = true;
  }
  return becomes;
}

void SampleStretch::append(SampleStretch& next) {
  const BatchView from = next.sample_.view();
  const std::vector<uint32_t> becomes = appendVertices(next, from);
  for (size_t cell = 0; cell < from.cell_count; ++cell) {
    uint32_t rows[4];
    for (size_t j = 0; j < 4; ++j) rows[j] = becomes[static_cast<size_t>(from.cells[4 * cell + j])];
    const bool whole = std::find(rows, rows + 4, kNone) == rows + 4;
    for (uint32_t row : rows)
      if (row != kNone) (whole ? used_ : cut_)[row] = true;
    if (whole) copyCell(from, cell, rows, next.part_of_[cell]);
  }
}

void SampleStretch::forgetRanks() {
  std::vector<uint32_t>().swap(row_of_);
  std::vector<uint64_t>().swap(rank_of_);
}

}  // namespace tetstream
