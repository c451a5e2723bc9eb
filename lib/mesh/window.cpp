#include "window.h"

#include <algorithm>

#include "tasks.h"

namespace tetstream {

template <class S>
void Window<S>::sizeVertices() {
  const size_t n = mesh.vertexCapacity();
  // note: three numbers more: rows are read four numbers at a time.
  values_.resize(checkedMultiply(n, static_cast<size_t>(shape_.values)) + 3);
  quadrics_.resize(checkedMultiply(n, static_cast<size_t>(shape_.quadric)) + 3);
  picks_.resize(checkedMultiply(n, static_cast<size_t>(shape_.picks)));
  out_rank_.resize(n);
  origins_.resize(shape_.origins ? n : 0);
  remap_.resize(n);
}

template <class S>
void Window<S>::sizeCells() {
  const size_t n = mesh.cellCapacity();
  cell_means_.resize(checkedMultiply(n, static_cast<size_t>(meansStride())));
  cell_picks_.resize(checkedMultiply(n, static_cast<size_t>(shape_.cell_picks)));
  first_points_.resize(shape_.points ? n : 0);
}

// Some more than will come: pages are asked for by the dozen.
template <class S>
void Window<S>::expect(size_t cells, size_t vertices) {
  constexpr size_t kCells = size_t{1} << 12, kVertices = size_t{1} << 10;
  const size_t cell_end = std::min(mesh.cellEnd() + cells, mesh.cellCapacity());
  if (cell_end > expected_cells_) {
    const size_t first = expected_cells_;
    expected_cells_ = std::min(std::max(cell_end, first + kCells), mesh.cellCapacity());
    expectCells(first, expected_cells_);
  }
  const size_t vertex_end = std::min(mesh.vertexEnd() + vertices, mesh.vertexCapacity());
  if (vertex_end > expected_vertices_) {
    const size_t first = expected_vertices_;
    expected_vertices_ = std::min(std::max(vertex_end, first + kVertices), mesh.vertexCapacity());
    expectVertices(first, expected_vertices_);
  }
}

template <class S>
void Window<S>::expectCells(size_t first, size_t end) {
  mesh.expectCells(first, end);
  const auto rows = [first, end](auto& array, size_t stride) {
    array.expect(first * stride, end * stride);
  };
  rows(cell_means_, static_cast<size_t>(meansStride()));
  rows(cell_picks_, static_cast<size_t>(shape_.cell_picks));
  rows(first_points_, shape_.points ? 1 : 0);
}

template <class S>
void Window<S>::expectVertices(size_t first, size_t end) {
  mesh.expectVertices(first, end);
  const auto rows = [first, end](auto& array, size_t stride) {
    array.expect(first * stride, end * stride);
  };
  rows(values_, static_cast<size_t>(shape_.values));
  rows(quadrics_, static_cast<size_t>(shape_.quadric));
  rows(picks_, static_cast<size_t>(shape_.picks));
  rows(out_rank_, 1);
  rows(origins_, shape_.origins ? 1 : 0);
  rows(remap_, 1);
}

template <class S>
void Window<S>::growCells(size_t capacity) {
  const size_t before = mesh.cellCapacity();
  try {
    mesh.growCells(capacity);
    sizeCells();
  } catch (...) {
    mesh.growCells(before);
    sizeCells();
    throw;
  }
}

template <class S>
void Window<S>::growVertices(size_t capacity) {
  const size_t before = mesh.vertexCapacity();
  try {
    mesh.growVertices(capacity);
    sizeVertices();
  } catch (...) {
    mesh.growVertices(before);
    sizeVertices();
    throw;
  }
}

template <class S>
uint32_t Window<S>::chooseVertices(uint64_t* unused) {
  uint32_t kept = 0;
  for (uint32_t v = 0; v < mesh.vertexEnd(); ++v) {
    const uint8_t flags = mesh.vertexFlags(v);
    const bool keep = remap_[v] > 0 || !(flags & kFinal) || mesh.isOfParked(v);
    remap_[v] = keep ? kept++ : kNone;
    *unused += !keep && !(flags & (kCollapsed | kWritten));
  }
  return kept;
}

template <class T>
static void moveRow(T* array, size_t stride, uint32_t from, uint32_t to) {
  copyRow(array + from * stride, stride, array + to * stride);
}

template <class S>
void Window<S>::moveVertices(uint32_t end) {
  for (uint32_t v = 0; v < end; ++v) {
    const uint32_t to = remap_[v];
    if (to == kNone || to == v) continue;
    moveRow(values_.data(), static_cast<size_t>(shape_.values), v, to);
    moveRow(quadrics_.data(), static_cast<size_t>(shape_.quadric), v, to);
    moveRow(picks_.data(), static_cast<size_t>(shape_.picks), v, to);
    out_rank_[to] = out_rank_[v];
    if (shape_.origins) origins_[to] = origins_[v];
  }
}

template <class S>
void Window<S>::packCells(uint32_t kept_vertices) {
  faces.remapVertices(remap_.data());
  mesh.pack(remap_.data(), kept_vertices, [this](uint32_t from, uint32_t to) {
    if (from == to) return;
    if (faces.anyPlaced()) faces.moveCell(from, to);
    moveRow(cell_means_.data(), static_cast<size_t>(meansStride()), from, to);
    moveRow(cell_picks_.data(), static_cast<size_t>(shape_.cell_picks), from, to);
    if (shape_.points) first_points_[to] = first_points_[from];
  });
}

template <class S>
uint64_t Window<S>::pack(Front& front, const Tasks* tasks) {
  uint64_t unused = 0;
  const uint32_t kept = chooseVertices(&unused);
  const uint32_t end = mesh.vertexEnd();
  const auto pack_rows = [&] {
    moveVertices(end);
    front.remap(remap_.data());
    curves.remap(remap_.data());
  };
  doBoth(tasks, pack_rows, [this, kept] { packCells(kept); });
  return unused;
}

template class Window<float>;
template class Window<double>;

}  // namespace tetstream
