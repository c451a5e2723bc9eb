#include "window.h"

#include <algorithm>

#include "tasks.h"

namespace tetstream {

// Numbers beyond the last row: rows are read four numbers at a time.
constexpr size_t kReadBeyond = 3;

// visit(array, numbers of a row, numbers beyond)
template <class S>
template <class Visit>
void Window<S>::forVertexArrays(Visit visit) {
  visit(values_, static_cast<size_t>(shape_.values), kReadBeyond);
  visit(quadrics_, static_cast<size_t>(shape_.quadric), kReadBeyond);
  visit(picks_, static_cast<size_t>(shape_.picks), size_t{0});
  visit(out_rank_, size_t{1}, size_t{0});
  visit(origins_, size_t{shape_.origins}, size_t{0});
  visit(errors_, size_t{shape_.errors}, size_t{0});
  visit(remap_, size_t{1}, size_t{0});
}

template <class S>
template <class Visit>
void Window<S>::forCellArrays(Visit visit) {
  visit(cell_means_, static_cast<size_t>(meansStride()), size_t{0});
  visit(cell_picks_, static_cast<size_t>(shape_.cell_picks), size_t{0});
  visit(first_points_, size_t{shape_.points}, size_t{0});
}

static auto resizedTo(size_t rows) {
  return [rows](auto& array, size_t row, size_t beyond) {
    array.resize(checkedMultiply(rows, row) + beyond);
  };
}

static auto expected(size_t first, size_t end) {
  return [first, end](auto& array, size_t row, size_t) { array.expect(first * row, end * row); };
}

template <class S>
void Window<S>::sizeVertices() {
  forVertexArrays(resizedTo(mesh.vertexCapacity()));
}

template <class S>
void Window<S>::sizeCells() {
  forCellArrays(resizedTo(mesh.cellCapacity()));
}

// Pages are asked for by the dozen: expect(first, end) for so many rows or more beyond those that
// were expected, up to `wanted`.
template <class Expect>
static void expectUpTo(size_t wanted, size_t least, size_t capacity, size_t* expected,
                       Expect expect) {
  const size_t first = *expected;
  if (std::min(wanted, capacity) <= first) return;
  *expected = std::min(std::max(wanted, first + least), capacity);
  expect(first, *expected);
}

template <class S>
void Window<S>::expect(size_t cells, size_t vertices) {
  expectUpTo(mesh.cellEnd() + cells, size_t{1} << 12, mesh.cellCapacity(), &expected_cells_,
             [this](size_t first, size_t end) {
               mesh.expectCells(first, end);
               forCellArrays(expected(first, end));
             });
  expectUpTo(mesh.vertexEnd() + vertices, size_t{1} << 10, mesh.vertexCapacity(),
             &expected_vertices_, [this](size_t first, size_t end) {
               mesh.expectVertices(first, end);
               forVertexArrays(expected(first, end));
             });
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
    if (shape_.errors) errors_[to] = errors_[v];
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
