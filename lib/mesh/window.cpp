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
