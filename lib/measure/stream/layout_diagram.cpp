#include "layout_diagram.h"

#include <algorithm>

namespace tetstream {

LayoutDiagram::LayoutDiagram(const Schema& schema, size_t columns, size_t rows)
    : meter_(account_),
      raster_(account_, columns, rows, schema.cell_count, schema.vertex_count),
      since_(account_),
      front_(columns) {}

static DiagramColumn joined(const DiagramColumn& a, const DiagramColumn& b) {
  if (b.width == 0) return a;
  return {std::max(a.width, b.width), std::min(a.lowest, b.lowest), b.newest};
}

// For one more cell.
void LayoutDiagram::makeRoom() {
  while (!raster_.reaches(cells() + 1)) {
    raster_.halveColumns();
    const size_t size = front_.size();
    for (size_t i = 0; 2 * i < size; ++i)
      front_[i] = 2 * i + 1 < size ? joined(front_[2 * i], front_[2 * i + 1]) : front_[2 * i];
    std::fill(front_.begin() + static_cast<ptrdiff_t>((size + 1) / 2), front_.end(),
              DiagramColumn());
  }
}

// Of the vertices introduced from `first` on.
void LayoutDiagram::startLines(uint64_t first, uint64_t time) {
  if (since_.size() < meter_.vertexRows()) since_.resize(meter_.vertexRows());
  for (uint64_t v = first; v < vertices(); ++v) {
    raster_.start(v, time);
    const uint32_t slot = meter_.front().find(v);
    if (slot != kNoSlot) since_[slot] = time;
  }
}

void LayoutDiagram::endLife(uint64_t since) {
  const auto life = static_cast<int64_t>(cells() - since);
  figures_.longest_life = std::max(figures_.longest_life, life);
}

// At the end of the last cell.
void LayoutDiagram::finalize(int64_t vertex) {
  const uint64_t introduced = vertices();
  const uint32_t slot = meter_.finalize(vertex);
  startLines(introduced, cells());
  const auto line = static_cast<uint64_t>(vertex);
  if (line < introduced) endLife(since_[slot]);
  raster_.end(line, cells());
}

// The front while the last cell is read: what it introduces is there, and what it finalizes still.
void LayoutDiagram::look() {
  const Front& front = meter_.front();
  const auto cell = static_cast<int64_t>(cells()) - 1;
  const auto width = static_cast<int64_t>(front.active());
  const auto lowest = static_cast<int64_t>(front.lowest());
  const auto newest = static_cast<int64_t>(front.introduced()) - 1;
  sum_of_widths_ += static_cast<double>(width);
  sum_of_spans_ += static_cast<double>(newest - lowest + 1);
  DiagramColumn& column = front_[static_cast<uint64_t>(cell) / raster_.columnWidth()];
  column = joined(column.width == 0 ? DiagramColumn{0, lowest, newest} : column,
                  {width, lowest, newest});
  if (width > figures_.front.width) {
    figures_.front.width = width;
    figures_.widest_cell = cell;
  }
  if (newest - lowest + 1 > figures_.front.span) {
    figures_.front.span = newest - lowest + 1;
    figures_.longest_cell = cell;
  }
}

void LayoutDiagram::addCell(const int64_t corners[4], unsigned last_uses) {
  makeRoom();
  const uint64_t introduced = vertices(), time = cells();
  meter_.addCell(corners);
  startLines(introduced, time);
  look();
  for (unsigned j = 0; j < 4; ++j)
    if (last_uses >> j & 1) finalize(corners[j]);
  meter_.note();
}

void LayoutDiagram::put(const BatchView& batch) {
  meter_.declare(batch);
  for (size_t i = 0; i < batch.cell_count; ++i)
    addCell(batch.cells + 4 * i, batch.last_uses ? batch.last_uses[i] : 0);
  for (size_t i = 0; i < batch.finalized_count; ++i) finalize(batch.finalized[i]);
  meter_.note();
}

void LayoutDiagram::finish() {
  const Front& front = meter_.front();
  if (front.active() > 0) endLife(since_[front.find(front.lowest())]);
  raster_.endAll(cells());
  figures_.cells = static_cast<int64_t>(cells());
  figures_.vertices = static_cast<int64_t>(vertices());
  figures_.front = meter_.statistics();
  if (cells() > 0) {
    figures_.mean_width = sum_of_widths_ / static_cast<double>(cells());
    figures_.mean_span = sum_of_spans_ / static_cast<double>(cells());
    figures_.mean_life = sum_of_widths_ / static_cast<double>(vertices());
  }
  front_.resize(columns());
  coverage_.resize(columns() * rows());
  raster_.coverage(cells(), vertices(), coverage_.data());
}

}  // namespace tetstream
